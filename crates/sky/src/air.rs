//! What the atmosphere is made of, and how light fares in it.

use light::Spectrum;
use light::bands::BANDS;

use crate::atmosphere::{CLEAR_TURBIDITY, ozone_absorption, rayleigh_depth};
use crate::phase::Lobes;
use crate::slant::{self, GLOBE};
use crate::solar_spectrum;

/// One number per band, in f64.
pub(crate) type Wide = [f64; BANDS];

/// Height over which aerosol thins out to 1/e \[m\] (thesis 4.2).
const AEROSOL_SCALE_HEIGHT: f64 = 1200.0;

/// A spherical atmosphere of molecules, aerosol and ozone over a matt ground at sea level.
///
/// Molecules and aerosol thin out exponentially with height (thesis 4.2, assumptions a and b).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Air {
    /// Ångström's β ≥ 0, the vertical optical depth of aerosol at 1 µm from sea level; it falls as 1/λ.
    pub turbidity: f64,
    /// Share of what aerosol takes out of a beam that it scatters, 0 to 1.
    pub aerosol_albedo: f64,
    /// Into which directions.
    pub aerosol_phase: Lobes,
    /// Column of ozone \[atm-cm\]; 300 Dobson units are 0.3.
    pub ozone: f64,
    /// Column of molecules, relative to that of the standard atmosphere.
    pub molecules: f64,
    /// Height over which molecules thin out to 1/e \[m\].
    pub molecule_scale_height: f64,
    /// Where scattering ends \[m\].
    pub top: f64,
    /// Reflectance of the ground far around, 0 to 1, which lights the air from below.
    pub ground_albedo: f64,
    /// Whether light that is scattered again, or that the ground sends back, counts.
    pub multiple: bool,
}

impl Air {
    /// Clear air, whose sun and sky have the illuminances of the IES: each value lies within what occurs,
    /// though rather at the clean end (aerosol that absorbs nothing, ozone of the tropics), and nothing else
    /// but the table in the tests has chosen them.
    pub const CLEAR: Self = Self {
        turbidity: CLEAR_TURBIDITY,
        aerosol_albedo: 1.0,
        aerosol_phase: Lobes::REPAIRED,
        ozone: 0.23,
        molecules: 1.0,
        molecule_scale_height: 8434.0,
        top: 100_000.0,
        ground_albedo: 0.2,
        multiple: true,
    };
    /// The thesis' air: single scattering (4.15 with the aerosol's density put in), the haze of 4.16 with a = 0.02,
    /// i.e. 8π · 0.02 = 0.503 of what aerosol takes out scattered, B = 0.09, an atmosphere of 30 km, no ozone.
    ///
    /// N = 2.5473e25 m⁻³ with a scale height of 7994 m, without King's factor, is 0.900 of the true depth.
    pub const THESIS: Self = Self {
        turbidity: 0.09,
        aerosol_albedo: 0.502_65,
        aerosol_phase: Lobes::HAZE,
        ozone: 0.0,
        molecules: 0.900,
        molecule_scale_height: 7994.0,
        top: 30_000.0,
        ground_albedo: 0.0,
        multiple: false,
    };
    /// The thesis' air with a haze that absorbs nothing and whose phase function makes its claim of 20 % true.
    pub const REPAIRED: Self = Self { aerosol_albedo: 1.0, aerosol_phase: Lobes::REPAIRED, ..Self::THESIS };
}

/// How light of the bands fares in [`Air`].
#[derive(Clone, Debug)]
pub(crate) struct Optics {
    pub(crate) air: Air,
    /// Scattering coefficient of molecules at sea level \[1/m\].
    pub(crate) molecules: Wide,
    /// Extinction coefficient of aerosol at sea level \[1/m\].
    pub(crate) aerosol: Wide,
    /// Vertical optical depth of ozone.
    ozone: Wide,
    /// The sun outside \[W m⁻² nm⁻¹\].
    pub(crate) sun: Wide,
}

impl Optics {
    /// One wavelength stands for each band: that at which λ⁻⁴ has its mean over the band, weighed with the sun, so
    /// that thin air scatters exactly what it should; ozone's absorption is the band's mean.
    pub(crate) fn new(air: &Air) -> Self {
        let sun = solar_spectrum::extraterrestrial();
        let weighed = |f: &dyn Fn(f64) -> f64| -> Wide {
            let sum = Spectrum::from_fn(|nm| f(nm) * solar_spectrum::irradiance(nm));
            std::array::from_fn(|band| f64::from(sum[band]) / f64::from(sun[band]))
        };
        let fourth = weighed(&|nm| (550.0 / nm).powi(4));
        let wavelengths = fourth.map(|mean| 550.0 * mean.powf(-0.25));
        let ozone = weighed(&ozone_absorption);
        Self::with(air, wavelengths, ozone, std::array::from_fn(|band| f64::from(sun[band])))
    }

    /// Eight single wavelengths \[nm\] in place of bands.
    #[cfg(test)]
    pub(crate) fn at(air: &Air, wavelengths: Wide) -> Self {
        Self::with(
            air,
            wavelengths,
            wavelengths.map(ozone_absorption),
            wavelengths.map(solar_spectrum::irradiance),
        )
    }

    /// Vertical optical depth of ozone in a band.
    #[cfg(test)]
    pub(crate) fn ozone_depth(&self, band: usize) -> f64 {
        self.ozone[band]
    }

    fn with(air: &Air, wavelengths: Wide, ozone: Wide, sun: Wide) -> Self {
        let air = Air {
            turbidity: air.turbidity.max(0.0),
            aerosol_albedo: air.aerosol_albedo.clamp(0.0, 1.0),
            ground_albedo: air.ground_albedo.clamp(0.0, 1.0),
            ..*air
        };
        Self {
            air,
            molecules: wavelengths.map(|nm| air.molecules * rayleigh_depth(nm) / air.molecule_scale_height),
            aerosol: wavelengths.map(|nm| air.turbidity * 1000.0 / nm / AEROSOL_SCALE_HEIGHT),
            ozone: ozone.map(|k| air.ozone * k),
            sun,
        }
    }

    /// Density of molecules and of aerosol at a height \[m\], that at sea level 1.
    pub(crate) fn densities(&self, height: f64) -> [f64; 2] {
        [(-height / self.air.molecule_scale_height).exp(), (-height / AEROSOL_SCALE_HEIGHT).exp()]
    }

    /// What a ray meets from distance `r` off the globe's centre, at cosine `mu` to the vertical, outwards.
    pub(crate) fn columns(&self, r: f64, mu: f64) -> Columns {
        columns(&self.air, r, mu)
    }

    /// e^(−τ) of each band.
    pub(crate) fn transmittance(&self, columns: &Columns) -> Wide {
        let [molecules, aerosol, ozone] = columns.0;
        std::array::from_fn(|band| {
            let depth =
                molecules * self.molecules[band] + aerosol * self.aerosol[band] + ozone * self.ozone[band];
            (-depth).exp()
        })
    }

    /// Share of the sun's disc above the globe's rim, 0 to 1, smoothly, seen from distance `r`, where its centre
    /// is at cosine `mu` to the vertical.
    pub(crate) fn risen(r: f64, mu: f64) -> f64 {
        const RADIUS: f64 = 0.004_65;
        // The rim stands at −√(1 − (R/r)²).
        let rim = -((r - GLOBE) * (r + GLOBE)).max(0.0).sqrt() / r;
        let t = (0.5 + 0.5 * (mu - rim) / RADIUS).clamp(0.0, 1.0);
        t * t * (3.0 - 2.0 * t)
    }

    /// The direct sun at distance `r`, facing it \[W m⁻² nm⁻¹\].
    pub(crate) fn sunlight(&self, r: f64, mu: f64) -> Wide {
        let risen = Self::risen(r, mu);
        if risen == 0.0 {
            return [0.0; BANDS];
        }
        let through = self.transmittance(&self.columns(r, mu));
        std::array::from_fn(|band| risen * self.sun[band] * through[band])
    }
}

/// Columns along a ray: of molecules and of aerosol \[m of air at sea level\], of ozone in thicknesses of its
/// layer.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Columns(pub(crate) [f64; 3]);

impl Columns {
    /// What remains between two points; rounding may not make it negative.
    pub(crate) fn less(self, other: Self) -> Self {
        Self(std::array::from_fn(|i| (self.0[i] - other.0[i]).max(0.0)))
    }

    pub(crate) fn plus(self, other: Self) -> Self {
        Self(std::array::from_fn(|i| self.0[i] + other.0[i]))
    }
}

/// See [`Optics::columns`].
pub(crate) fn columns(air: &Air, r: f64, mu: f64) -> Columns {
    Columns([
        slant::exponential(air.molecule_scale_height, r, mu),
        slant::exponential(AEROSOL_SCALE_HEIGHT, r, mu),
        slant::ozone(r, mu),
    ])
}

/// Vertical optical depths at sea level of molecules, aerosol and ozone at a wavelength \[nm\], by column of
/// [`columns`].
pub(crate) fn per_column(air: &Air, nm: f64) -> [f64; 3] {
    [
        air.molecules * rayleigh_depth(nm) / air.molecule_scale_height,
        air.turbidity * 1000.0 / nm / AEROSOL_SCALE_HEIGHT,
        air.ozone * ozone_absorption(nm),
    ]
}
