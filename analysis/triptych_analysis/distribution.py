"""The distribution of the values (the paper's Figures 3 and 10): histograms, percentiles, a log-normal fit, and a
Kolmogorov–Smirnov test of the fit."""

import numpy as np
import pandas as pd
from scipy import stats

from .splits import levels_in, scope

LEAST = 8  # the smallest number of observations for a fit
PERCENTS = [0, 5, 10, 25, 50, 75, 90, 95, 99, 100]
MOST_REPLICATES, LEAST_REPLICATES = 999, 99
MOST_DRAWS = 20_000_000  # the most random numbers for one test, which limits it to a few seconds


def fit_log_normal(values):
    """Returns the maximum-likelihood estimates of mu and sigma for ln x ~ N(mu, sigma²)."""
    logs = np.log(values)
    return float(logs.mean()), float(logs.std())


def ks_log_normal(values):
    """Returns (D, p) of the Kolmogorov–Smirnov test against the log-normal distribution that was fitted to the same values. As
    in the paper, p is computed as if the parameters were known beforehand, so it is too large."""
    mu, sigma = fit_log_normal(values)
    test = stats.kstest((np.log(values) - mu) / sigma, "norm")
    return float(test.statistic), float(test.pvalue)


def lilliefors_p(d, n, replicates, seed):
    """Returns the p-value of the Kolmogorov–Smirnov statistic `d` of `n` values to which the distribution was fitted (Lilliefors
    1967). The function draws `replicates` random normal samples of n values, fits a normal distribution to each of them, and
    computes the statistic of each fit. If k of the samples have a statistic of at least `d`, p = (1 + k)/(1 + replicates)."""
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
    """Returns the rows (low, high, count, expected) of a histogram with bins of equal width over the range of the values or of
    their logarithms. `expected` is the count according to the fit. The number of bins is that of Freedman and Diaconis (1981),
    but at least 5 and at most 60."""
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
    """Returns three tables for all values together and for the values of each device. At least LEAST values are needed, which
    must not all be equal. If every record has times from both clocks, all values together are analysed with both clocks.

    The column `of` is "all" or "device=NAME", `samples` is the number of values, and `held` lists the factors that have the same
    level in all these observations, such as "step=1, viewport=64".
    1. Fits: the mean, the parameters mu and sigma of the log-normal fit, D (`ks_d`) and p (`ks_p`) of ks_log_normal(), p of
       lilliefors_p(), and the number of its replicates.
    2. Percentiles: one row for each of PERCENTS.
    3. Histograms: one row for each bin from histogram(), with a linear and with a logarithmic `scale`."""
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
