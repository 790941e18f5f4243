//! The program. All of it is in the library beside this file, so that tests of its parts don't compile it a second time.

fn main() -> std::process::ExitCode {
    brinell::main()
}
