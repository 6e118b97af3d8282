//! The types of the `wedm/` methods, shared by server and command line.
