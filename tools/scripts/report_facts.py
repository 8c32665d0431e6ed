# SPDX-License-Identifier: BSD-3-Clause
"""What a report tells of a substrate: what was asked for, by the stages in its manifest, and what was reached, by its tables."""

import math

GROWING = ("FibreRadialGrowth", "SubstrateProduction")
COATING = ("MyelinSurface", "SubstrateProduction")


def stages_of(manifest, *filters):
    """Properties of each stage that is one of these filters."""
    return [stage.get("properties", {}) for stage in manifest["provenance"] if stage.get("filter") in filters]


def only(values):
    """The one value that all share; None where there is none, or several."""
    different = {repr(value): value for value in values if value is not None}
    return next(iter(different.values())) if len(different) == 1 else None


def in_domain(fibres):
    """Of rows by fibre, those whose centre line enters the domain: of fibres that only graze it there are more the thicker they are."""
    return [fibre for fibre in fibres if fibre.get("Length_um", 1.0) > 0.0]


def mean_radius(fibres, name):
    """Mean of a column of radii, weighted by the fibres' lengths in the domain; by number in folders without lengths."""
    known = [(fibre[name], fibre.get("Length_um", 1.0)) for fibre in in_domain(fibres) if math.isfinite(fibre[name])]
    return math.fsum(radius * length for radius, length in known) / math.fsum(length for _, length in known) if known else math.nan


def source_of_all(manifest, names):
    """Those properties of the source of all fibres, or of several that have the same; None where they differ, or some fibres are of another kind
    of source."""
    if stages_of(manifest, "StrandReader", "TractFibres", "CurvedBundles"):
        return None
    return only({name: source.get(name) for name in names} for source in stages_of(manifest, "BundleInitializer"))


class AskedRadii:
    """The distribution of outer radii (µm) that all fibres were drawn from."""

    NAMES = ("RadiusDistribution", "GammaShape", "GammaScale", "LognormalMean", "LognormalDeviation", "MinimumRadius", "MaximumRadius")

    def __init__(self, manifest):
        self.source = source_of_all(manifest, self.NAMES)
        self.density = self._density() if self.source else []

    def _log_weight(self, radius):
        values = self.source
        if values.get("RadiusDistribution") == "Gamma":
            return (values["GammaShape"] - 1.0) * math.log(radius) - radius / values["GammaScale"]
        variance = math.log1p((values["LognormalDeviation"] / values["LognormalMean"]) ** 2)
        middle = math.log(values["LognormalMean"]) - 0.5 * variance
        return -0.5 * (math.log(radius) - middle) ** 2 / variance - math.log(radius)

    def _density(self, count=400):
        """[(radius, density)], cut to its limits. Nothing for a table, which has none, and for one radius."""
        if self.source.get("RadiusDistribution") not in ("Gamma", "Lognormal"):
            return []
        low, high = self.source["MinimumRadius"], self.source["MaximumRadius"]
        if low == high:
            return []
        step = (high - low) / count
        points = [(low + (i + 0.5) * step, self._log_weight(low + (i + 0.5) * step)) for i in range(count)]
        largest = max(weight for _, weight in points)
        points = [(radius, math.exp(weight - largest)) for radius, weight in points]
        whole = math.fsum(weight for _, weight in points) * step
        return [(radius, weight / whole) for radius, weight in points]

    def mean(self):
        if not self.density:
            low, high = ((self.source or {}).get(name) for name in ("MinimumRadius", "MaximumRadius"))
            return low if low == high else None
        return math.fsum(radius * weight for radius, weight in self.density) / math.fsum(weight for _, weight in self.density)


def ks_distance(radii, density):
    """Kolmogorov-Smirnov distance of radii to the distribution that they were drawn from, [(radius, density)] at equal steps; NaN where it has none."""
    if not density:
        return math.nan
    step = density[1][0] - density[0][0]
    below_it, largest, count = 0.0, 0.0, 0
    radii = sorted(radii)
    for radius, weight in density:
        below_it += weight * step
        while count < len(radii) and radii[count] <= radius + step / 2:
            count += 1
        largest = max(largest, abs(count / len(radii) - below_it))
    return largest


def asked_fraction(manifest):
    """The fibre volume fraction that growth was to reach; None where it grew by steps."""
    growth = only(stages_of(manifest, *GROWING))
    if growth is None:
        return None
    target = growth.get("TargetFibreVolumeFraction", 0.0)
    if target < 0.0:
        # Fibres of files do not say what they were made for, and those along a tract or a curve only of what their bundles fill.
        if stages_of(manifest, "TractFibres", "CurvedBundles"):
            return None
        shares = [source.get("GrownFibreVolumeFraction", 0.0) for source in stages_of(manifest, "BundleInitializer", "StrandReader")]
        target = math.fsum(shares) if all(share > 0.0 for share in shares) else 0.0
    return target if target > 0.0 else None


def asked_g_ratio(manifest):
    """The one g-ratio of all fibres; None in the other models, and where a bundle has its own."""
    if any(source.get("GRatio") for source in stages_of(manifest, "BundleInitializer", "TractFibres", "CurvedBundles")):
        return None
    return only(values.get("GRatio") if values.get("GRatioModel") == "Constant" else None for values in stages_of(manifest, *COATING))


def asked_and_reached(manifest, certificate, fibres, dispersion):
    """[(quantity, asked or None, reached)] of a substrate. `certificate` = {quantity: value}, `fibres` = rows of its table by fibre,
    `dispersion` = the mean angle in degrees between fibres and their bundle's axis, or None."""
    fraction, g = asked_fraction(manifest), asked_g_ratio(manifest)
    directions = manifest.get("directions", {})
    axons = fraction * g * g if fraction is not None and g is not None else None
    axons = only(values.get("TargetAxonVolumeFraction") for values in stages_of(manifest, *COATING)
                 if values.get("GRatioModel") == "TargetAxonVolumeFraction") or axons
    if manifest.get("sample_of_fibres"):
        fraction = axons = None  # of all fibres
    rows = [
        ("fibres", manifest.get("sample_of_fibres"), float(len(fibres))),
        ("fibre volume fraction (FVF)", fraction, certificate.get("FVF")),
        ("axon volume fraction (AVF)", axons, certificate.get("AVF")),
        ("myelin volume fraction (MVF)", fraction - axons if axons is not None and fraction is not None else None, certificate.get("MVF")),
        ("aggregate g-ratio", g, certificate.get("AggregateGRatio")),
        ("mean outer radius (µm)", AskedRadii(manifest).mean(), mean_radius(fibres, "OuterRadius_um")),
        ("mean inner radius (µm)", None, mean_radius(fibres, "InnerRadius_um")),
        ("mean dispersion (degrees)", (source_of_all(manifest, ["MeanDispersion"]) or {}).get("MeanDispersion"), dispersion),
        ("orientation dispersion index (ODI)", None, directions.get("odi")),
        ("p2 of directions", None, directions.get("p2")),
        ("angular correlation with the directions asked for", None, directions.get("angular_correlation")),
        ("angle between fibres within 10 µm (degrees)", None, directions.get("local_spread_deg")),
        ("twist of the bundle", None, directions.get("twist")),
        ("sinuosity", (source_of_all(manifest, ["Sinuosity"]) or {}).get("Sinuosity"), directions.get("sinuosity")),
        ("smallest gap between fibres (µm)", certificate.get("MinimumGap_um"), certificate.get("SmallestGap_um")),
        ("thinnest myelin (µm)", None, certificate.get("SmallestMyelin_um")),
        ("triangles", None, certificate.get("Triangles")),
    ]
    return [(name, wanted, value) for name, wanted, value in rows if value is not None and not math.isnan(value)]
