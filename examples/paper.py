# SPDX-License-Identifier: BSD-3-Clause
"""The substrates of the CACTUS paper by name, and what the paper reports of them (its sides are 500 µm, those of HISTOLOGY 300 µm).

dispersion-D is one bundle with a mean dispersion of D degrees, each fibre's direction for itself, as in the paper; coherent-D one whose
neighbouring fibres point alike; all lie between walls, as in the paper; crossing-A are two bundles, of 5° each, that cross at A degrees (the
rows of the paper's table of maximum fibre volume fractions); histology-N is row N of its table of histological targets; radii-F is one
bundle of 10° with a fibre volume fraction of F. Radii are the defaults, Γ(2.4, 0.25) cut to 0.2-2 µm, which the paper's tutorial has; of
its own substrates the paper does not tell them. In histology-N and radii-F they are those that fibres end with. The others start with them and
are grown to be as dense as can be, so that all end thicker by the same amount: dense bundles of thin fibres are held apart by their gaps.
Capsules of a fibre are equally thick, as they start in the paper; what varies along a fibre comes of its growth.
"""

# {mean dispersion: (fibres, fibre volume fraction)} and {crossing angle: ...} in the paper's Table 1.
DISPERSION = {0: (31954, 0.947), 5: (31023, 0.934), 10: (30241, 0.926), 15: (30412, 0.922), 20: (31161, 0.918), 25: (31863, 0.908)}
CROSSING = {30: (30026, 0.939), 45: (30712, 0.933), 60: (31023, 0.935), 75: (31152, 0.923), 90: (30245, 0.922)}

# Its Table 2, after Stikov et al. 2015: (AVF, MVF, FVF, aggregate g-ratio) asked for and reached.
HISTOLOGY = [
    ((0.25, 0.35, 0.60, 0.645), (0.260, 0.360, 0.620, 0.647)),
    ((0.25, 0.43, 0.68, 0.606), (0.263, 0.436, 0.699, 0.613)),
    ((0.31, 0.44, 0.75, 0.642), (0.322, 0.438, 0.7607, 0.650)),
    ((0.39, 0.37, 0.76, 0.716), (0.412, 0.350, 0.760, 0.735)),
]


def properties(name, side, seed=1, fraction=0.955, tolerance=0.0065):
    """The properties of BundleInitializer, FibreRadialGrowth and MyelinSurface for the substrate of that name, or None. `fraction` is the
    fibre volume fraction of those that are as dense as can be, `tolerance` their SurfaceTolerance (µm), which leaves room for it."""
    kind, _, number = name.partition("-")
    bundle = {"Side": side, "Seed": seed, "Border": "Walls", "FibreVolumeFraction": 0.7, "CalibreVariation": 0}
    rough = {"SurfaceRoughness": 0.1}
    growth = {"TargetFibreVolumeFraction": fraction, "SurfaceTolerance": tolerance, **rough}
    myelin = {"GRatio": 0.7}
    if kind == "dispersion":
        bundle.update(MeanDispersion=float(number), DispersionModel="Watson", GrownFibreVolumeFraction=0)
    elif kind == "coherent":
        bundle.update(MeanDispersion=float(number), GrownFibreVolumeFraction=0)
    elif kind == "crossing":
        bundle = {"Preset": "Crossing at 90 degrees", **bundle, "CrossingAngle": float(number)}
    elif kind == "histology":
        del bundle["FibreVolumeFraction"]
        bundle = {"Preset": f"Histological target {'abcd'[int(number) - 1]}", **bundle}
        growth, myelin = rough, {}  # the rest follows from the bundle's
    elif kind == "radii":
        bundle.update(MeanDispersion=10, GrownFibreVolumeFraction=float(number))
        growth = rough
    else:
        return None
    return bundle, growth, myelin
