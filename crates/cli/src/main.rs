//! `keikan`: landscape and lighting simulation.

use std::process::ExitCode;

use clap::Parser;

fn main() -> ExitCode {
    // A wrong argument ends here with clap's own message and exit code 2.
    let cli = keikan::args::Cli::parse();
    match keikan::run(&cli) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("keikan: {error}");
            ExitCode::from(error.exit_code())
        }
    }
}
