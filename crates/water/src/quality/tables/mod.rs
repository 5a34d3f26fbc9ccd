//! Published coefficients of water.

pub(crate) mod jerlov;
pub(crate) mod pure;
