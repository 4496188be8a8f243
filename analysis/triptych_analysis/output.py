"""An analysis as files, and as what a terminal shows."""

import os

from . import drawing, figures


def write(of, folder):
    """Tables and figures of one analysis. What an earlier one left there is gone."""
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
    """What a terminal shows."""
    data = of.dataset
    what = f"{data.clock} time" if data.signal == "time" else "instructions of device code and driver"
    lines = [f"{data.suite}: {len(data)} configurations on their devices, {what}"]
    lines += [f"  {each}" for each in data.notes]
    if len(data.duplicates):
        first = data.duplicates.iloc[0]
        lines.append(f"  {len(data.duplicates)} measured more than once, the latest taken; first: {first.configuration} "
                     f"on {first.device}, {first.taken} over {first.dropped}")
    for each in of.table("distributions").itertuples():
        lines.append(f"  {each.of} ({each.clock}, {each.samples} samples): log-normal D = {each.ks_d:.3f}, "
                     f"p = {each.ks_p:.2g}, Lilliefors p = {each.lilliefors_p:.3g}")
    for each in of.table("correlation_boxes").itertuples():
        lines.append(f"  r between levels of {each.factor}: mean {each.mean:.3f}, {each.minimum:.3f}…"
                     f"{each.maximum:.3f} ({each.cells} pairs of {each.levels} levels, {each.samples} samples)")
    for each in of.table("predictions").itertuples():
        if each.data in ("all", "every held-out observation"):
            lines.append(f"  R² of {each.data}: lines {each.line_r2:.3f}, forest {each.forest_r2:.3f} "
                         f"({each.held_out:.0f} held out; {each.structures_left_out} of {each.structures} structures "
                         "had too few samples for a line)")
    for each in of.table("camera_paths").itertuples():
        if each.subsets_of == "samples":
            lines.append(f"  {each.path} against all views: D = {each.d:.3f}, p = {each.p:.2g} ({each.samples} of "
                         f"{each.all_samples} samples); random samples rejected {each.rejected} of {each.subsets}")
    for each in of.table("stacks").itertuples():
        lines.append(f"  r along {each.name}: mean {each.mean:.3f}, least {each.minimum:.3f} ({each.levels} sizes)")
    for each in of.table("effects").head(3).itertuples():
        ratio = f", ×{each.largest_ratio:.3g} from {each.cheap} to {each.dear}" if each.pairs else ""
        lines.append(f"  {each.factor} moves it: {each.share:.2f} of the variance of ln{ratio}")
    return lines + [f"  left out: {what}: {why}" for what, why in of.left_out]
