#!/usr/bin/env python3
"""Fits the eight spectral bands of keikan and its reflectance basis; prints Rust constants.

A band is a smooth kernel, a *biweight* (1 - u^2)^2, u = (wavelength - centre) / half-width, normalised to
weight 1. Lights, reflectances and coefficients are all projected by the same kernels, multiplied band by band,
and turned into XYZ by a 3 x 8 matrix W >= 0. Fitted: 8 centres, 8 half-widths (CMA-ES), and for each candidate the
best W (non-negative least squares, reweighted towards the p-norm, p = 6) in a metric that is CIEDE2000 linearised
around each reference colour. Held exactly: W 1 = integral of the colour matching functions (constant spectra), and
W P(D65) = white of sRGB (a white surface in daylight is white).

Run as:
    python3 -m venv venv && venv/bin/pip install numpy scipy cma==4.5.0 colour-science==0.4.7 prosail==2.0.5
    venv/bin/python docs/bands/fit.py            # a few minutes; prints constants and the error of each group
    venv/bin/python docs/bands/fit.py --tables   # prints the tables of crates/light/src/data
"""

import csv
import pathlib
import sys
import warnings

import numpy as np

warnings.filterwarnings("ignore")
import cma
import colour
import prosail
from scipy.optimize import minimize, nnls

HERE = pathlib.Path(__file__).parent
STEP = 5.0
NM = np.arange(380.0, 780.1, STEP)
SHAPE = colour.SpectralShape(380, 780, 5)
BANDS = 8


def at_5nm(distribution):
    return distribution.copy().align(SHAPE).values


def column(file, name):
    rows = list(csv.reader(line for line in open(HERE / file) if not line.startswith("#")))
    at = rows[0].index(name)
    table = np.array([(float(r[0]), float(r[at])) for r in rows[1:] if r[at]])
    return np.interp(NM, table[:, 0], table[:, 1])


CMF = at_5nm(colour.MSDS_CMFS["CIE 1931 2 Degree Standard Observer"])
BASIS = [at_5nm(colour.colorimetry.SDS_BASIS_FUNCTIONS_CIE_ILLUMINANT_D_SERIES[k]) for k in ("S0", "S1", "S2")]
WATER = column("spectra.csv", "water_absorption")
SUN = column("spectra.csv", "sun")
SUN_SMOOTH = column("spectra.csv", "sun_smooth")
# Linear sRGB to XYZ from the primaries and white of IEC 61966-2-1.
PRIMARIES = np.array([[0.64, 0.33], [0.30, 0.60], [0.15, 0.06]])
WHITE_XY = np.array([0.3127, 0.3290])


def xyz_from_srgb():
    columns = np.stack([np.array([x / y, 1.0, (1 - x - y) / y]) for x, y in PRIMARIES], axis=1)
    x, y = WHITE_XY
    return columns * np.linalg.solve(columns, [x / y, 1.0, (1 - x - y) / y])


SRGB = xyz_from_srgb()
WHITE = SRGB.sum(axis=1)



def planck(kelvin):
    metres = NM * 1e-9
    return metres**-5 / np.expm1(1.438776877e-2 / (metres * kelvin))


def daylight(kelvin):
    """CIE D-series (CIE 015:2018, 4.1.2)."""
    t = 1e3 / kelvin
    if kelvin <= 7000:
        x = ((-4.6070 * t + 2.9678) * t + 0.09911) * t + 0.244063
    else:
        x = ((-2.0064 * t + 1.9018) * t + 0.24748) * t + 0.237040
    y = -3.0 * x * x + 2.870 * x - 0.275
    m = 0.0241 + 0.2562 * x - 0.7341 * y
    m1 = (-1.3515 - 1.7703 * x + 5.9114 * y) / m
    m2 = (0.0300 - 31.4424 * x + 30.0717 * y) / m
    return BASIS[0] + m1 * BASIS[1] + m2 * BASIS[2]


D65 = daylight(6504.0)
RAYLEIGH = 0.008735 * (NM / 1000) ** -4.08


def through_air(sun, masses, turbidity):
    return sun * np.exp(-masses * (RAYLEIGH + turbidity * (NM / 1000) ** -1.3))


def blue_sky(sun, masses, turbidity):
    return through_air(sun, masses, turbidity) * (5 * RAYLEIGH + turbidity * (NM / 1000) ** -1.3)


def leaf(structure=1.5, chlorophyll=40.0, carotenoid=8.0, anthocyanin=0.0, brown=0.0):
    """Reflectance and transmittance by PROSPECT-D (Feret et al. 2017)."""
    nm, reflected, passed = prosail.run_prospect(
        structure, chlorophyll, carotenoid, brown, 0.0125, 0.009, ant=anthocyanin, prospect_version="D"
    )
    return np.interp(NM, nm, reflected), np.interp(NM, nm, passed)


def random_leaf(rng):
    return leaf(
        rng.uniform(1.1, 2.5), rng.uniform(2, 80), rng.uniform(2, 18),
        rng.choice([0, 0, rng.uniform(0, 12)]), rng.choice([0, rng.uniform(0, 0.6)]),
    )  # fmt: skip


def random_sigmoid(rng):
    c = rng.normal(0, 1.5, 3)
    u = (NM - 580) / 200
    return 1 / (1 + np.exp(-(2 * c[0] + 3 * c[1] * u + 6 * c[2] * u * u)))


def random_bumps(rng):
    r = np.full_like(NM, rng.uniform(0, 0.3))
    for _ in range(2):
        r += rng.uniform(0, 0.5) * np.exp(-(((NM - rng.uniform(380, 740)) / rng.uniform(40, 120)) ** 2))
    return np.clip(r, 0, 1)



def lab(xyz, white):
    t = xyz / white
    f = np.where(t > (6 / 29) ** 3, np.cbrt(t), t / (3 * (6 / 29) ** 2) + 4 / 29)
    return np.stack([116 * f[..., 1] - 16, 500 * (f[..., 0] - f[..., 1]), 200 * (f[..., 1] - f[..., 2])], -1)


def difference(a, b):
    return colour.delta_E(a, b, method="CIE 2000")


class Cases:
    """Colours as light x reflectance x exp(-depth).

    Adapted white: for a light (no reflectance), D65 of the reference's own luminance; for a surface, the light on it.
    """

    def __init__(self):
        self.group, self.light, self.reflectance, self.depth, self.weight, self.surface = [], [], [], [], [], []

    def add(self, group, light, reflectance=None, depth=None, weight=1.0):
        self.group.append(group)
        self.light.append(light / (light @ CMF[:, 1]))
        self.reflectance.append(np.ones_like(NM) if reflectance is None else reflectance)
        self.depth.append(np.zeros_like(NM) if depth is None else depth)
        self.weight.append(weight)
        self.surface.append(reflectance is not None)

    def finish(self):
        for name in ("light", "reflectance", "depth", "weight", "surface"):
            setattr(self, name, np.array(getattr(self, name)))
        arriving = self.light * np.exp(-self.depth)
        self.xyz = (arriving * self.reflectance) @ CMF
        self.white = np.where(self.surface[:, None], arriving @ CMF, WHITE * self.xyz[:, 1:2])
        self.metric = self.linearised()
        return self

    def linearised(self):
        """A with |A (xyz - reference)| = CIEDE2000 for small differences."""
        centre, eye = lab(self.xyz, self.white), np.eye(3)
        h = self.xyz * 1e-4 + 1e-9 * self.white
        jacobian = np.stack(
            [(lab(self.xyz + h * eye[i], self.white) - centre) / h[:, i : i + 1] for i in range(3)], -1
        )
        d, squared = 0.05, np.zeros((len(h), 3, 3))
        along = lambda v: (difference(centre, centre + d * v) / d) ** 2
        for i in range(3):
            squared[:, i, i] = along(eye[i])
        for i in range(3):
            for j in range(i):
                mixed = (along(eye[i] + eye[j]) - squared[:, i, i] - squared[:, j, j]) / 2
                squared[:, i, j] = squared[:, j, i] = mixed
        values, vectors = np.linalg.eigh(squared)
        values = np.maximum(values, 1e-4 * values.max(1, keepdims=True))
        return (np.sqrt(values)[:, :, None] * np.swapaxes(vectors, 1, 2)) @ jacobian

    def bands(self, kernel):
        return (self.light @ kernel.T) * (self.reflectance @ kernel.T) * np.exp(-(self.depth @ kernel.T))

    def errors(self, kernel, weights):
        xyz = self.bands(kernel) @ weights.T
        return difference(lab(self.xyz, self.white), lab(xyz, self.white)), xyz[:, 1] / self.xyz[:, 1] - 1


def cases(seed, count):
    rng = np.random.default_rng(seed)
    pick = lambda choices: choices[rng.integers(len(choices))]
    days = [daylight(t) for t in (4000, 4500, 5003, 5503, 6000, 6504, 7504, 8500, 10000, 12000, 15000, 20000, 25000)]
    glows = [planck(t) for t in (1800, 2200, 2500, 2700, 2856, 3000, 3200, 3500, 4000, 5000, 6500, 9000)]
    names = ["B1", "B2", "B3", "B4", "B5", "BH1", "V1", "V2"]
    leds = [at_5nm(colour.SDS_ILLUMINANTS[f"LED-{k}"]) for k in names]
    leds.append(at_5nm(colour.SDS_LIGHT_SOURCES["Phosphor LED YAG"]))
    air = [(s, m, b) for s in (SUN, SUN_SMOOTH) for m in (1, 2, 4) for b in (0.03, 0.2)]
    outdoors = [through_air(*a) for a in air] + [blue_sky(*a) for a in air]
    usual = [D65, days[2], days[6], days[8], through_air(SUN, 1.5, 0.1), blue_sky(SUN, 1.2, 0.05), SUN]
    every = days + glows + leds + outdoors
    these = Cases()
    for group, lights, weight in (("daylight", days + outdoors, 2), ("glow", glows, 2), ("led", leds, 1)):
        for light in lights:
            these.add(group, light, weight=weight)
    for k in [f"FL{i}" for i in range(1, 13)] + [f"HP{i}" for i in range(1, 6)]:
        these.add("line lamp", at_5nm(colour.SDS_ILLUMINANTS[k]), weight=0.05)
    for chip in colour.SDS_COLOURCHECKERS["ColorChecker N Ohta"].values():
        for light in (D65, glows[4], usual[4]):
            these.add("colour chart", light, np.clip(at_5nm(chip), 0, 1), weight=0.6)
    for metres in np.geomspace(0.2, 12, 14):
        for light in usual:
            these.add("water", light, None, WATER * metres, weight=1.5)
    for i in range(count):
        these.add("leaf", pick(usual), random_leaf(rng)[i % 2])
        these.add("smooth surface", pick(every), (random_sigmoid, random_bumps)[i % 2](rng), weight=0.9)
    for _ in range(count // 2):
        yellow = rng.choice([0, rng.uniform(0, 0.1)]) * np.exp(-0.015 * (NM - 440))
        these.add("yellow water", pick(usual), None, rng.uniform(0, 10) * (WATER + yellow), weight=0.8)
        these.add("leaf in water", pick(usual), random_leaf(rng)[0], WATER * rng.uniform(0, 10), weight=1.3)
    return these.finish()



def kernels(parameters):
    centre, half = parameters[:BANDS, None], parameters[BANDS:, None]
    u = (NM - centre) / half
    k = np.where(np.abs(u) < 1, (1 - u * u) ** 2, 0.0)
    return k / k.sum(1, keepdims=True)


def best_weights(these, kernel, rounds):
    """W (3 x 8, >= 0) and the 6-norm of the linearised errors; 2 % of luminance counts as 1 CIEDE2000."""
    power, unknowns = 6, 3 * BANDS
    v, weight = these.bands(kernel), these.weight[:, None, None]
    rows = (these.metric[:, :, :, None] * v[:, None, None, :]).reshape(len(v), 3, unknowns)
    target = np.einsum("nij,nj->ni", these.metric, these.xyz)
    bright = np.zeros((len(v), 1, unknowns))
    bright[:, 0, BANDS : 2 * BANDS] = v / these.xyz[:, 1:2]
    rows = np.concatenate([rows, 50 * bright], 1) * weight
    target = np.concatenate([target, np.full((len(v), 1), 50.0)], 1) * weight[:, :, 0]
    fixed, value = constraints(kernel)
    importance = np.ones(len(v))
    for _ in range(rounds):
        normal = np.einsum("nij,n,nik->jk", rows, importance, rows) + 1e6 * len(v) * fixed.T @ fixed
        right = np.einsum("nij,n,ni->j", rows, importance, target) + 1e6 * len(v) * fixed.T @ value
        scale = 1 / np.sqrt(np.diag(normal))
        factor = np.linalg.cholesky(normal * scale[:, None] * scale + 1e-12 * np.eye(unknowns))
        w = nnls(factor.T, np.linalg.solve(factor, right * scale), maxiter=500)[0] * scale
        residual = np.linalg.norm(np.einsum("nij,j->ni", rows, w) - target, axis=1)
        importance = np.sqrt(importance) * ((residual + 0.02) / (residual.mean() + 0.02)) ** ((power - 2) / 2)
        importance /= importance.mean()
    return w.reshape(3, BANDS), np.mean(residual**power) ** (1 / power)


def constraints(kernel):
    """Rows and values of: constants exact (each divided by its integral), white under D65 exact."""
    white = kernel @ (D65 / (D65 @ CMF[:, 1]))
    fixed, value = np.zeros((6, 3 * BANDS)), np.ones(6)
    for i in range(3):
        fixed[i, i * BANDS : (i + 1) * BANDS] = 1 / CMF[:, i].sum()
        fixed[3 + i, i * BANDS : (i + 1) * BANDS] = white / WHITE[i]
    return fixed, value


def exact(weights, kernel):
    """The nearest matrix that meets the constraints to rounding and stays >= 0; entries below 1e-3 become 0."""
    fixed, value = constraints(kernel)
    w = weights.ravel().copy()
    free = w > 1e-3
    for _ in range(10):
        w[~free] = 0.0
        w[free] += np.linalg.pinv(fixed[:, free]) @ (value - fixed[:, free] @ w[free])
        if (w >= 0).all():
            break
        free &= w > 0
    assert (w >= 0).all() and np.abs(fixed @ w - value).max() < 1e-9, (w, fixed @ w - value)
    return w.reshape(3, BANDS)


def search(these, evaluations=5_000, seed=4):
    def loss(p):
        if np.diff(p[:BANDS]).min() < 8 or p[BANDS:].min() < 15 or p[BANDS:].max() > 90 or p[0] < 385 or p[7] > 720:
            return 1e3
        try:
            return best_weights(these, kernels(p), 4)[1]
        except (np.linalg.LinAlgError, RuntimeError):
            return 1e3

    # Near where searches of 10 000 evaluations from equal spacing ended.
    start = np.array([434, 461, 495, 534, 572, 610, 643, 684, 26, 24, 18, 30, 27, 29, 18, 15.0])
    strategy = cma.CMAEvolutionStrategy(start, 8, {"seed": seed, "verbose": -9, "popsize": 16})
    while strategy.result.evaluations < evaluations and not strategy.stop():
        points = strategy.ask()
        strategy.tell(points, [loss(np.array(p)) for p in points])
    return strategy.result.xbest, strategy.result.fbest


def reflectance_basis(centres, weights, white):
    """Three spectra, sum 1 in each band, within [0, 1], of exact linear sRGB colour under D65, of least curvature."""
    third = np.zeros((BANDS - 2, BANDS))
    for i in range(BANDS - 2):
        a, b = np.diff(centres[i : i + 3]) / 30.0
        third[i, i : i + 3] = 2 / (a * (a + b)), -2 / (a * b), 2 / (b * (a + b))
    rows = [np.tile(np.eye(BANDS), 3)]
    rows += [np.kron(np.eye(3)[i], weights * white) for i in range(2)]
    fixed = np.concatenate(rows)
    value = np.r_[np.ones(BANDS), SRGB[:, 0], SRGB[:, 1]]
    curvature = np.kron(np.eye(3), third.T @ third)
    result = minimize(
        lambda s: s @ curvature @ s, np.full(3 * BANDS, 1 / 3), jac=lambda s: 2 * curvature @ s, method="SLSQP",
        bounds=[(0, 1)] * (3 * BANDS), constraints={"type": "eq", "fun": lambda s: fixed @ s - value, "jac": lambda _: fixed},
        options={"maxiter": 1000, "ftol": 1e-14},
    )  # fmt: skip
    assert result.success, result.message
    grid = 2.0**20  # multiples of 2^-20, so that the three sum to 1 exactly in f32
    s = np.round(np.clip(result.x.reshape(3, BANDS), 0, 1) * grid)
    s[1] = grid - s[0] - s[2]
    assert (s >= 0).all(), s
    return s / grid


def rust(name, rows):
    number = lambda v: np.format_float_positional(np.float32(v), unique=True, trim="0")
    body = ",\n".join("    [" + ", ".join(number(v) for v in row) + "]" for row in np.atleast_2d(rows))
    print(f"{name} = [\n{body},\n];")


def report(name, these, kernel, weights):
    error, bright = these.errors(kernel, weights)
    for group in dict.fromkeys(these.group):
        m = np.array([g == group for g in these.group])
        print(
            f"// {name:8} {group:15} n {m.sum():3}  dE2000 max {error[m].max():5.2f} p95 {np.percentile(error[m], 95):5.2f}"
            f" mean {error[m].mean():5.2f}   luminance max {100 * np.abs(bright[m]).max():5.2f} %"
        )


def fit():
    train, held = cases(11, 200), cases(99, 400)
    found, loss = search(train)
    parameters = np.round(found, 1)
    kernel = kernels(parameters)
    weights = exact(best_weights(train, kernel, 12)[0], kernel)
    print(f"// loss {loss:.4f}", flush=True)
    print("CENTRES", list(parameters[:BANDS]), "HALF_WIDTHS", list(parameters[BANDS:]))
    rust("XYZ_WEIGHTS (nm)", weights * STEP)
    white = kernel @ (D65 / (D65 @ CMF[:, 1]))
    rust("D65 (luminance 1 cd/m2 in W/sr/m2/nm)", white / (683.0 * STEP))
    rust("REFLECTANCE", reflectance_basis(parameters[:BANDS], weights, white))
    report("train", train, kernel, weights)
    report("held out", held, kernel, weights)


def tables():
    def table(name, values, digits):
        print(name, len(values))
        for i in range(0, len(values), 9):
            print("    " + ", ".join(f"{v:.{digits}f}" for v in values[i : i + 9]) + ",")

    for i, name in enumerate("XYZ"):
        table(name, CMF[:, i], 6)
    for i, values in enumerate(BASIS):
        table(f"S{i}", values, 3)
    reflected, passed = leaf()
    table("leaf reflectance", reflected, 4)
    table("leaf transmittance", passed, 4)
    table("water", WATER, 5)
    table("sun", SUN, 4)
    table("LED-B3", at_5nm(colour.SDS_ILLUMINANTS["LED-B3"]), 3)
    table("foliage", at_5nm(colour.SDS_COLOURCHECKERS["ColorChecker N Ohta"]["foliage"]), 4)


if __name__ == "__main__":
    tables() if "--tables" in sys.argv else fit()
