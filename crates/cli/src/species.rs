//! `keikan tree`: species of trees, listed and made.

use std::fmt;
use std::path::PathBuf;

use rayon::prelude::*;
use scene::species_folder;

use crate::Error;
use crate::args;
use crate::assemble::{Made, Worn, baked, from_photos, grown, tree_names};
use crate::command::{pretty, say};
use crate::output::{self, Folder, Target};

/// Lists or makes species.
///
/// # Errors
/// Something of which no species can be made, a folder that cannot be written.
pub(crate) fn run(args: &args::Tree, json: bool) -> Result<(), Error> {
    let report = match args {
        args::Tree::List => return list(json),
        args::Tree::Grow(args) => {
            let (folder, mesh) =
                (Folder::new(&args.output)?, args.mesh.as_deref().map(Target::new).transpose()?);
            let (made, pieces) = grown(args)?;
            let more = mesh.into_iter().map(|target| (target, output::encode_glb(&pieces))).collect();
            let mut report = Report { more: args.mesh.clone(), ..Report::new(made) };
            report.write(folder, more)?;
            report
        }
        args::Tree::Bake(args) => {
            let folder = Folder::new(&args.output)?;
            let (made, materials, warnings) = baked(args)?;
            warnings.iter().for_each(|warning| eprintln!("warning: {warning}"));
            let mut report = Report { materials, ..Report::new(made) };
            report.write(folder, Vec::new())?;
            report
        }
        args::Tree::Photo(args) => {
            let folder = Folder::new(&args.output)?;
            let (made, notes) = from_photos(args)?;
            let mut report = Report { notes, ..Report::new(made) };
            report.write(folder, Vec::new())?;
            report
        }
    };
    say(&if json { pretty(&report) } else { report.to_string() })
}

fn list(json: bool) -> Result<(), Error> {
    let names: Vec<_> = tree_names().collect();
    let all = names.into_par_iter().map(Made::named).collect::<Result<Vec<_>, _>>()?;
    if json {
        return say(&pretty(&all));
    }
    let lines: Vec<_> = std::iter::once(Made::heading()).chain(all.iter().map(Made::line)).collect();
    say(&lines.join("\n"))
}

/// What was made, from what, and where it is.
#[derive(Clone, Debug, serde::Serialize)]
struct Report {
    species: Made,
    /// Materials of a model, and what they count as.
    materials: Vec<Worn>,
    /// What was made up.
    notes: Vec<String>,
    written: Vec<PathBuf>,
    /// A file outside the folder.
    #[serde(skip)]
    more: Option<PathBuf>,
}

impl Report {
    fn new(species: Made) -> Self {
        Self { species, materials: Vec::new(), notes: Vec::new(), written: Vec::new(), more: None }
    }

    /// The folder of the species, together with files that are ready.
    fn write(&mut self, folder: Folder, ready: Vec<(Target, Vec<u8>)>) -> Result<(), Error> {
        let files = species_folder::files(&self.species.kept())?;
        self.written = folder.write(files, ready)?;
        self.written.extend(self.more.take());
        Ok(())
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.species)?;
        for Worn { material, triangles, leaves, why } in &self.materials {
            let kind = if *leaves { "leaves" } else { "wood" };
            write!(f, "\n  material {material}: {triangles} triangles, {kind}: {why}")?;
        }
        self.notes.iter().try_for_each(|note| write!(f, "\n  {note}"))?;
        self.written.iter().try_for_each(|path| write!(f, "\nwritten: {}", path.display()))
    }
}
