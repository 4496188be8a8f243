"""Writes an analysis to files, and composes the summary that is printed."""

import os

from . import drawing, figures


def write(of, folder):
    """Writes the tables and figures of an analysis to a folder. Removes the files of an earlier analysis from the folder
    first."""
    os.makedirs(folder, exist_ok=True)
    for name in os.listdir(folder):
        if name.endswith((".csv", ".svg")):
            os.remove(os.path.join(folder, name))
    for name, table in of.tables.items():
        table.to_csv(os.path.join(folder, f"{name}.csv"), index=False, lineterminator="\n")
    for name, made in figures.every(of):
        safe = "".join(each if each.isalnum() or each in "_-" else "_" for each in name)
        drawing.save(made, os.path.join(folder, f"{safe}.svg"))


def summary(of):
    """Returns the lines of the summary."""
    data = of.dataset
    what = f"{data.clock} time" if data.signal == "time" else "instructions of device code and driver"
    lines = [f"{data.suite}: {len(data)} observations (one per configuration and device), {what}"]
    lines += [f"  {each}" for each in data.notes]
    if len(data.duplicates):
        first = data.duplicates.iloc[0]
        lines.append(f"  {len(data.duplicates)} earlier measurements of the same configuration and device are not used; "
                     f"for example, for {first.configuration} on {first.device}, {first.taken} is used instead of {first.dropped}")
    for each in of.table("distributions").itertuples():
        lines.append(f"  {each.of} ({each.clock}, {each.samples} samples) compared with a log-normal distribution: "
                     f"D = {each.ks_d:.3f}, p = {each.ks_p:.2g}, Lilliefors p = {each.lilliefors_p:.3g}")
    for each in of.table("correlation_boxes").itertuples():
        lines.append(f"  Pearson's r between two levels of {each.factor}: mean {each.mean:.3f}, {each.minimum:.3f} to "
                     f"{each.maximum:.3f} ({each.cells} pairs of {each.levels} levels, {each.samples} samples)")
    for each in of.table("predictions").itertuples():
        if each.data in ("all", "every held-out observation"):
            lines.append(f"  R² of predictions ({each.data}): linear models {each.line_r2:.3f}, "
                         f"random forest {each.forest_r2:.3f} "
                         f"({each.held_out:.0f} held-out observations; {each.structures_left_out} of "
                         f"{each.structures} data structures had too few samples for a linear model)")
    for each in of.table("camera_paths").itertuples():
        if each.subsets_of == "samples":
            lines.append(f"  {each.path} compared with all views: D = {each.d:.3f}, p = {each.p:.2g} ({each.samples} of "
                         f"{each.all_samples} samples); "
                         f"the test rejects {each.rejected} of {each.subsets} random samples of this size")
    for each in of.table("stacks").itertuples():
        lines.append(f"  Pearson's r between two sizes of {each.name}: mean {each.mean:.3f}, minimum {each.minimum:.3f} "
                     f"({each.levels} sizes)")
    for each in of.table("effects").head(3).itertuples():
        ratio = (f"; the value with {each.expensive} is {each.largest_ratio:.3g} times the value with {each.cheap}"
                 if each.pairs else "")
        lines.append(f"  influence of {each.factor}: {each.share:.2f} of the variance of the value's logarithm{ratio}")
    return lines + [f"  not computed: {what}: {why}" for what, why in of.left_out]
