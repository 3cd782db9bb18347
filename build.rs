//! Tells the laboratory's reports which compiler and, in a release, which commit they are about.

use std::process::Command;

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    let compiler = std::env::var("RUSTC").unwrap_or_else(|_| "rustc".to_owned());
    say("SIXFOLD_COMPILER", &compiler, &["--version"]);
    // Not in other profiles: every commit would compile everything anew.
    if std::env::var("PROFILE").is_ok_and(|profile| profile == "release") {
        println!("cargo::rerun-if-changed=.git/HEAD");
        say(
            "SIXFOLD_COMMIT",
            "git",
            &["describe", "--always", "--dirty", "--abbrev=12"],
        );
    }
}

/// Sets a variable of the build to a program's first line; without the program there is no variable.
fn say(name: &str, program: &str, arguments: &[&str]) {
    let output = Command::new(program).args(arguments).output();
    if let Some(output) = output.ok().filter(|output| output.status.success())
        && let Some(line) = String::from_utf8_lossy(&output.stdout).lines().next()
    {
        println!("cargo::rustc-env={name}={line}");
    }
}
