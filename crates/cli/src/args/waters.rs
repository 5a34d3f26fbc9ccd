//! The arguments of `keikan water`.

use clap::Args;

/// `keikan water`.
#[derive(Args, Clone, Debug)]
#[command(after_help = EXAMPLES)]
pub struct Water {
    /// A water by name, or a scene file (.toml) whose waters are meant; all that there are by name without one.
    pub water: Option<String>,
    /// Instead: depth at which a white disc vanishes, in metres.
    #[arg(long, value_name = "M", conflicts_with = "water")]
    pub secchi: Option<f64>,
    /// Instead: chlorophyll, in mg/m³.
    #[arg(long, value_name = "MG/M3", conflicts_with_all = ["water", "secchi"])]
    pub chlorophyll: Option<f64>,
}

/// What stands below the options of `keikan water --help`.
const EXAMPLES: &str = "\
Examples:
  keikan water
      every water that has a name, a line each
  keikan water jerlov-3C
      its coefficients and 1/e depths by wavelength, critical angle, colours of a white bottom by depth
  keikan water pond.toml --json
      the same of the waters in a scene file, for machines";
