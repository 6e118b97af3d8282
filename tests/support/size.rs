//! How much of what takes long is tried: some by day, all by night.

/// `tests/random`, which runs by night, says how many cases are drawn; a run by day does not.
pub fn by_day<T>(some: T, all: T) -> T {
    match std::env::var_os("WEDM_CASES") {
        None => some,
        Some(_) => all,
    }
}
