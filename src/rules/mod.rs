//! The rules: one file each, with its check and its fix.
