//! Colour temperatures as files write them.

/// What counts as a colour temperature \[K\]: from the dullest amber to the bluest sky.
const KELVIN: std::ops::RangeInclusive<f64> = 1000.0..=25_000.0;

/// A number of kelvins that says so: `3000K`, `4000 K`, within other words.
pub(super) fn with_unit(text: &str) -> Option<f64> {
    let bytes = text.as_bytes();
    let mut start = 0;
    while start < bytes.len() {
        let digits = bytes[start..].iter().take_while(|byte| byte.is_ascii_digit()).count();
        let end = start + digits;
        let fresh = start == 0 || !(bytes[start - 1].is_ascii_alphanumeric() || bytes[start - 1] == b'.');
        if digits >= 4 && fresh {
            let unit =
                bytes[end..].iter().position(|&byte| byte != b' ').map_or(bytes.len(), |gap| end + gap);
            let named = bytes.get(unit) == Some(&b'K') || bytes.get(unit) == Some(&b'k');
            let ends = !bytes.get(unit + 1).is_some_and(u8::is_ascii_alphanumeric);
            if named && ends {
                return text[start..end].parse().ok().filter(|kelvin| KELVIN.contains(kelvin));
            }
        }
        start = end.max(start + 1);
    }
    None
}

/// A field that is meant for it: `3000`, `3000 K`, or the code of lamp makers, `830` (colour rendering 80,
/// 3000 K), alone or among other words.
pub(super) fn in_field(text: &str) -> Option<f64> {
    with_unit(text).or_else(|| {
        let words = || text.split(|c: char| !c.is_ascii_alphanumeric()).filter(|word| !word.is_empty());
        let plain = words().find_map(|word| word.parse().ok().filter(|kelvin| KELVIN.contains(kelvin)));
        let code = || {
            words().find_map(|word| {
                let code: u32 = word.parse().ok().filter(|_| word.len() == 3)?;
                let kelvin = f64::from(code % 100) * 100.0;
                (code >= 500 && KELVIN.contains(&kelvin)).then_some(kelvin)
            })
        };
        plain.or_else(code)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn as_files_write_them() {
        assert_eq!(with_unit("Generic 15W LED 3000K CRI80"), Some(3000.0));
        assert_eq!(with_unit("LED 4000 K"), Some(4000.0));
        assert_eq!(with_unit("12000 lm, 2700k."), Some(2700.0));
        for none in ["", "3000", "X3000K", "3000KB", "12 K", "99999K", "3000 LK", "ü3000°K"] {
            assert_eq!(with_unit(none), None, "{none}");
        }
        assert_eq!(in_field("3000"), Some(3000.0));
        assert_eq!(in_field("WW/830"), Some(3000.0));
        assert_eq!(in_field("tageslicht 965"), Some(6500.0));
        assert_eq!(in_field("warm white"), None);
    }
}
