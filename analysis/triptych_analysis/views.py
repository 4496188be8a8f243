"""Tests whether a camera path represents all views (sections 5.3 and 6.3 of the paper). A two-sample Kolmogorov–Smirnov test
compares the values of the path with all values. For comparison, the same test is applied to random subsets."""

import warnings

import numpy as np
import pandas as pd
from scipy import stats

from .dataset import view_of
from .splits import fullest_block, levels_in, scope

SUBSETS = 100
REJECTED_BELOW = 0.05
MOST_FOR_EXACT = 4_000_000  # the largest product of two sample sizes for which the exact distribution is computed


def ks_two_samples(a, b):
    """Returns (D, p) of the two-sided, two-sample Kolmogorov–Smirnov test of a and b, whose sizes are n and m. b must be sorted.
    If the samples are small (n·m ≤ MOST_FOR_EXACT), p is exact unless there are ties. If they are large, p is the p-value of the
    one-sample test for a sample of size n·m/(n + m)."""
    n, m = len(a), len(b)
    if n * m <= MOST_FOR_EXACT:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # SciPy warns if the exact count overflows, and then uses the asymptotic p
            test = stats.ks_2samp(a, b, method="exact")
        return float(test.statistic), float(test.pvalue)
    a = np.sort(a)
    here = np.searchsorted(b, a, side="right") / m  # the share of b that is ≤ each value in a …
    before = np.searchsorted(b, a, side="left") / m  # … and < each value in a
    up_to, below = np.searchsorted(a, a, side="right") / n, np.searchsorted(a, a, side="left") / n
    d = float(max(np.abs(here - up_to).max(), np.abs(before - below).max()))
    return d, float(stats.kstwo.sf(d, np.round(n * m / (n + m))))


def path_tests(dataset, seed):
    """Tests each path, using the configurations that were measured from the most views. Returns two rows for each path. In the
    first row, the path is compared with random subsets of as many values from any views, as in the paper (`subsets_of` is
    "samples"). In the second row, it is compared with random sets of as many views ("views"). Random subsets are taken from all
    values, so they are closer to all values than independent samples would be, and their p-values are larger than those of
    independent samples, which are uniformly distributed. Returns an empty table if there is only one path.

    `views` and `samples` are the numbers of views and of values of the path, and `all_views` and `all_samples` those of all
    paths together. `d` and `p` are the result of the test of the path. `subsets` is the number of random subsets, and `rejected`
    the number of them whose p is below REJECTED_BELOW. `d_mean` and the columns after it summarize the D and p of the subsets.
    `held` lists the factors that have the same level in all these observations, such as "step=1, viewport=64"."""
    columns = ["path", "views", "samples", "all_views", "all_samples", "d", "p", "subsets_of", "subsets", "rejected",
               "d_mean", "p_minimum", "p_mean", "p_median", "p_maximum", "held"]
    values, by_view = values_by_view(dataset)
    paths = {}
    for view in by_view:
        paths.setdefault(view_of(view)[0], []).append(view)
    if len(paths) < 2:
        return pd.DataFrame(columns=columns)
    held = scope(dataset, fullest_block(dataset, ["camera"]))["held"]
    random = np.random.default_rng(seed)
    rows = []
    for path, views in sorted(paths.items()):
        of_path = np.concatenate([by_view[each] for each in views])
        about = (path, len(views), len(of_path), len(by_view), len(values), *ks_two_samples(of_path, values))
        samples = [ks_two_samples(random.choice(values, len(of_path), replace=False), values) for _ in range(SUBSETS)]
        rows.append((*about, "samples", *_summary(samples), held))
        names = list(by_view)
        of_views = [ks_two_samples(np.concatenate([by_view[names[i]] for i in
                                                   random.choice(len(names), len(views), replace=False)]), values)
                    for _ in range(SUBSETS)]
        rows.append((*about, "views", *_summary(of_views), held))
    return pd.DataFrame(rows, columns=columns)


def values_by_view(dataset):
    """Returns the sorted values of the configurations that were measured from the most views, and a dictionary with the values
    of each view."""
    rows = fullest_block(dataset, ["camera"])
    return np.sort(dataset.values[rows]), {view: dataset.values[each]
                                  for view, each in levels_in(dataset, "camera", rows).items()}


def _summary(tests):
    d, p = np.array(tests).T
    return len(p), int((p < REJECTED_BELOW).sum()), d.mean(), p.min(), p.mean(), np.median(p), p.max()
