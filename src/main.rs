//! The one binary: with no arguments the explorer, else the command line.

fn main() {}
