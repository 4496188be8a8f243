"""The distribution of values (the paper's Figures 3 and 10): histograms, percentiles, a log-normal fit, and a
Kolmogorov–Smirnov test of the fit."""

import numpy as np
import pandas as pd
from scipy import stats

from .splits import levels_in, scope

LEAST = 8  # the smallest number of different observations
PERCENTS = [0, 5, 10, 25, 50, 75, 90, 95, 99, 100]
MOST_REPLICATES, LEAST_REPLICATES = 999, 99
MOST_DRAWS = 20_000_000  # takes some seconds


def fit_log_normal(values):
    """The maximum-likelihood estimates of mu and sigma for ln x ~ N(mu, sigma²)."""
    logs = np.log(values)
    return float(logs.mean()), float(logs.std())


def ks_log_normal(values):
    """(D, p) of the test against the log-normal distribution that was fitted to the same values. As in the paper, p treats
    the parameters as known, which makes it too large."""
    mu, sigma = fit_log_normal(values)
    test = stats.kstest((np.log(values) - mu) / sigma, "norm")
    return float(test.statistic), float(test.pvalue)


def lilliefors_p(d, n, replicates, seed):
    """p of the same D when the parameters were fitted (Lilliefors 1967). k of the random normal samples, each with its own
    fit, have a D at least as large; p = (1 + k)/(1 + replicates)."""
    random = np.random.default_rng(seed)
    upper = np.arange(1, n + 1) / n
    as_large = 0
    for _ in range(replicates):
        sample = random.standard_normal(n)
        sample = np.sort((sample - sample.mean()) / sample.std())
        below = stats.norm.cdf(sample)
        as_large += max((below - upper + 1 / n).max(), (upper - below).max()) >= d
    return (1 + as_large) / (1 + replicates)


def replicates_for(n):
    return int(np.clip(MOST_DRAWS // n, LEAST_REPLICATES, MOST_REPLICATES))


def histogram(values, logarithmic):
    """Equal bins over the range of the values or of their logarithms, with the counts that the fit expects. The number of
    bins follows Freedman and Diaconis (1981), between 5 and 60. Rows: low, high, count, expected."""
    scaled = np.log10(values) if logarithmic else values
    lower, upper = np.percentile(scaled, [25, 75])
    width = 2 * (upper - lower) / np.cbrt(len(scaled))
    count = int(np.clip(np.ceil(np.ptp(scaled) / width) if width > 0 else 60, 5, 60))
    counts, edges = np.histogram(scaled, bins=count)
    if logarithmic:
        edges = 10**edges
    mu, sigma = fit_log_normal(values)
    below = stats.norm.cdf((np.log(edges) - mu) / sigma)
    return [(edges[i], edges[i + 1], int(counts[i]), len(values) * (below[i + 1] - below[i])) for i in range(count)]


def distributions(dataset, seed):
    """Distributions of all values and of each device's values; for all values by both clocks if every record has both. At
    least LEAST different values are needed. Returns three tables: fits, percentiles, histograms."""
    fits, percentiles, bins = [], [], []
    for of, clock, rows, values in _samples(dataset):
        if len(values) < LEAST or not fit_log_normal(values)[1] > 0:
            continue
        held = scope(dataset, rows)["held"]
        about = (of, clock, len(values))
        d, p = ks_log_normal(values)
        replicates = replicates_for(len(values))
        fits.append((*about, values.mean(), *fit_log_normal(values), d, p,
                     lilliefors_p(d, len(values), replicates, seed), replicates, held))
        percentiles += [(*about, percent, value, held)
                        for percent, value in zip(PERCENTS, np.percentile(values, PERCENTS))]
        for scale in ("linear", "log10"):
            bins += [(*about[:2], scale, *each, len(values), held) for each in histogram(values, scale == "log10")]
    unit = dataset.unit
    return (pd.DataFrame(fits, columns=["of", "clock", "samples", f"mean_{unit}", "mu", "sigma", "ks_d", "ks_p",
                                        "lilliefors_p", "replicates", "held"]),
            pd.DataFrame(percentiles, columns=["of", "clock", "samples", "percentile", unit, "held"]),
            pd.DataFrame(bins, columns=["of", "clock", "scale", f"from_{unit}", f"to_{unit}", "count", "expected",
                                        "samples", "held"]))


def _samples(dataset):
    rows = np.arange(len(dataset))
    yield "all", dataset.clock, rows, dataset.values
    if dataset.signal == "time" and len(rows) and np.isfinite(dataset.device_ms).all():
        other = "wall" if dataset.clock == "device" else "device"
        yield "all", other, rows, dataset.wall_ms if other == "wall" else dataset.device_ms
    for device, of_device in levels_in(dataset, "device", rows).items():
        yield f"device={device}", dataset.clock, of_device, dataset.values[of_device]
