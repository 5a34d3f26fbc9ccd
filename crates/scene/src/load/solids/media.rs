//! A body of several shapes is filled with one medium.

use light::Medium;

use super::{Operand, Operation, Part};
use crate::document::Spot;
use crate::{Error, Material};

/// What one body is filled with, and the material that says so.
#[derive(Clone, Copy)]
struct Filling<'s> {
    /// None = opaque.
    medium: Option<Medium>,
    /// None = the default grey.
    material: Option<&'s Material>,
}

/// Looks for members of unions and intersections that are filled differently.
pub(super) struct Media<'s> {
    pub(super) all: &'s Spot<'s>,
    pub(super) parts: &'s [Part],
    /// Those of the file, by the index that parts carry.
    pub(super) materials: &'s [Material],
}

impl<'s> Media<'s> {
    /// Whether table `i` is a body of one medium.
    pub(super) fn check(&self, i: usize) -> Result<(), Error> {
        self.filling(i, None).map(|_| ())
    }

    /// What fills table `i`; `inherited` is the material of those parts that name none.
    ///
    /// In a union or an intersection, that of all members. In a difference, that of the whole: what is cut out
    /// leaves nothing inside, so its materials only dress the faces of the cut and are not looked at.
    fn filling(&self, i: usize, inherited: Option<u32>) -> Result<Filling<'s>, Error> {
        let part = &self.parts[i];
        let material = part.material.or(inherited);
        let (operation, members) = match &part.operand {
            Operand::Shape(..) => return Ok(self.filled_with(material)),
            Operand::Set(operation, members) => (*operation, members),
        };
        let first = self.filling(members[0], material)?;
        if operation == Operation::Difference {
            return Ok(first);
        }
        for (at, member) in members.iter().enumerate().skip(1) {
            let other = self.filling(*member, material)?;
            if other.medium != first.medium {
                let spot = self.all.index(i).key(operation.key()).index(at);
                return Err(spot.error(format!(
                    "is {}, but the first is {}: what lies in one another is one body of one medium; possible are materials \
                     that are all opaque, or alike in colour, transmission, ior and attenuation, or several [[solid]] tables",
                    other.describe(),
                    first.describe()
                )));
            }
        }
        Ok(first)
    }

    fn filled_with(&self, material: Option<u32>) -> Filling<'s> {
        let material = material.and_then(|index| self.materials.get(index as usize));
        // On a solid nothing is a thin pane.
        let medium = material.and_then(Material::medium).map(|medium| Medium { thin: false, ..medium });
        Filling { medium, material }
    }
}

impl Filling<'_> {
    fn describe(&self) -> String {
        let name = self.material.map_or("of the default grey".to_owned(), |m| format!("of {:?}", m.name));
        match self.medium {
            Some(medium) => format!("{name} (clear, ior {})", medium.index),
            None => format!("{name} (opaque)"),
        }
    }
}
