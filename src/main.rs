//! The binary: a language server without arguments, a command line with them.

fn main() -> std::process::ExitCode {
    wedm::cli::run()
}
