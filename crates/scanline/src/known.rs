//! What is known of the light on spans, by number.

use std::collections::HashMap;

use light::Known;

/// Numbers for what is known, equal ones for equal. 0 = nothing. They mean something only within one call, and
/// nothing may depend on their order.
#[derive(Default)]
pub(crate) struct Table {
    all: Vec<Known>,
    numbers: HashMap<Known, u32>,
}

impl Table {
    pub(crate) fn number(&mut self, known: Known) -> u32 {
        if known == Known::default() {
            return 0;
        }
        // Neighbouring spans mostly have the same light.
        if self.all.last() == Some(&known) {
            return self.all.len() as u32;
        }
        *self.numbers.entry(known).or_insert_with(|| {
            self.all.push(known);
            self.all.len() as u32
        })
    }

    /// Nothing for a number that is not of this table.
    pub(crate) fn known(&self, number: u32) -> Known {
        let index = (number as usize).wrapping_sub(1);
        self.all.get(index).copied().unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_knowledge_has_one_number() {
        let mut table = Table::default();
        let some: Vec<Known> = (0..9).map(|i| Known { lit: i % 3, dark: (i % 2) << 4 }).collect();
        let numbers: Vec<u32> = some.iter().map(|known| table.number(*known)).collect();
        for (known, number) in some.iter().zip(&numbers) {
            assert_eq!(table.known(*number), *known);
            assert_eq!(table.number(*known), *number);
        }
        assert_eq!(table.number(Known::default()), 0);
        assert_eq!(table.known(99), Known::default());
    }
}
