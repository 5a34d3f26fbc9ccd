//! Surfaces: what leaves a hit (thesis eq. 2.1 in physical units).
//!
//! **Answers** [`light::Shade`] three times: [`Surface`], the metals and dielectrics that glTF files describe,
//! [`Phong`], the thesis' own, and [`Glass`], the surface of a transparent body. The thesis writes
//!
//!   I = I_a + k_d Σ (L·N) t I_L + k_s S + k_t T
//!
//! which adds quantities of different kinds. Here, with E_i the irradiance of beam i facing its source,
//! E_f that of extended light on the surface, f the reflectance distribution \[1/sr\], R its integral for
//! the direction of the eye and L_m the radiance along the mirror direction:
//!
//!   L = L_e + Σ f(i) cos θ_i E_i + R_diffuse E_f/π + R_specular ((1 − w) E_f/π + w L_m)
//!
//! k_t T is added by [`Glass`].
//!
//! Every hit stands for a bundle of rays ([`light::Hit::width`]), which bent surfaces spread: highlights are as wide as its
//! normals make them. Below a roughness of 0.07 surfaces turn into mirrors, which show sources as soft discs of their
//! angular size, and sources without extent as glints as wide as the bundle.
//!
//! **Leaves out.** Layers of lacquer, anisotropy, sheen, subsurface scattering but for leaves
//! ([`Finish::diffuse_transmission`]).
//!
//! **Known to be wrong.** Of extended light a surface knows only how much arrives, not whence: its
//! specular share is spread evenly (rough surfaces) or taken from one mirror ray (smooth ones). A light
//! that a mirror ray can see itself is counted there and again in its beam's highlight, so a pipeline
//! should leave out the sun's disc beyond the first hit. Normal maps on mirrored texture coordinates
//! have their v axis the wrong way round.

mod albedo;
mod even;
mod finish;
mod glass;
mod lobe;
mod normals;
mod phong;
mod shading;

pub use finish::{Finish, Image, NormalMap, Surface};
pub use glass::Glass;
pub use phong::Phong;
pub use shading::NO_MIRROR;
