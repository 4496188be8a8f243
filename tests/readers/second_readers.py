#!/usr/bin/env python3
"""Reads files with Triptych and with a second, established program, and compares the results.

usage: second_readers.py --program READ_DATA [--generate FOLDER] [--list] [FILE|FOLDER ...]

For particles, it compares their number, elements and positions. For volumes, it compares the size,
the spacing and every value. With --generate, it writes one file of each format and variant into
FOLDER, and compares these files and the seeds of tests/fuzz. Files that either reader rejects are
counted. With --list, it also prints the reasons. The exit code is 1 if anything differs, and 77 if
no second reader is installed.
"""

import argparse
import bz2
import collections
import gzip
import inspect
import json
import pathlib
import subprocess
import sys
import tempfile
import warnings

warnings.filterwarnings("ignore")
try:
    import numpy as np
except ImportError:
    print("skipped: python3-numpy is not installed")
    sys.exit(77)

import generated_files
import generated_variants


class Refused(Exception):
    """Raised if the second reader cannot read the file, or by design reads different data than Triptych."""


class Particles:
    def __init__(self, places, elements=None, radii=None):
        self.places = np.asarray(places, float).reshape(-1, 3)
        self.elements = None if elements is None else [str(e).capitalize() for e in elements]
        self.radii = radii


class Volume:
    def __init__(self, values, spacing):
        self.values = np.asarray(values, float)  # x varies fastest, so the shape is (z, y, x)
        self.spacing = np.abs(np.asarray(spacing, float))


# Each of these functions reads a file of one format with a second reader, and returns Particles or a Volume. It raises
# ImportError if that reader is not installed.


def by_gemmi_pdb(path):
    import gemmi

    if text_of(path).startswith("\ufeff"):
        raise Refused("gemmi skips the line with the byte order mark")
    with unpacked(path) as plain:
        structure = gemmi.read_pdb(str(plain), split_chain_on_ter=True)
    if len(structure) == 0:
        raise Refused("no model")
    atoms = [a.atom for a in structure[0].all()]
    if not atoms:
        raise Refused("no atoms")
    elements = [a.element.name for a in atoms] if states_elements(path) else None
    return Particles([a.pos.tolist() for a in atoms], elements)


def states_elements(path):
    """Returns whether all atoms have an element in columns 77 and 78. If not, both readers guess elements."""
    import gemmi

    for line in text_of(path).splitlines():
        if line.startswith(("ATOM", "HETATM")):
            symbol = line[76:78].strip()
            if not symbol or gemmi.Element(symbol).atomic_number == 0:
                return False
        if line.startswith(("ENDMDL", "END ")):
            break
    return True


def by_gemmi_cif(path):
    import gemmi

    for block in gemmi.cif.read_string(text_of(path)):
        table = block.find("_atom_site.", ["type_symbol", "Cartn_x", "Cartn_y", "Cartn_z"])
        if len(table) == 0:
            continue
        model = block.find("_atom_site.", ["pdbx_PDB_model_num"])
        models = [row.str(0) for row in model] if len(model) else [""] * len(table)
        rows = [row for row, m in zip(table, models) if m == models[0]]
        symbols = [r.str(0).rstrip("0123456789+-") for r in rows]
        stated = all(s not in ("", "?", ".") for s in symbols)
        places = [[gemmi.cif.as_number(r[i]) for i in (1, 2, 3)] for r in rows]
        return Particles(places, symbols if stated else None)
    raise Refused("no atoms")


def by_mdanalysis(path, **options):
    import MDAnalysis

    with unpacked(path) as plain:
        try:
            universe = MDAnalysis.Universe(str(plain), **options)
        except Exception as error:
            raise Refused(f"MDAnalysis: {error}")
        return universe


def by_mdanalysis_gro(path):
    return Particles(by_mdanalysis(path, format="GRO", topology_format="GRO").atoms.positions / 10)


def by_mdanalysis_pqr(path):
    universe = by_mdanalysis(path, format="PQR", topology_format="PQR")
    return Particles(universe.atoms.positions, radii=universe.atoms.radii)


def by_ase_xyz(path):
    import ase.io

    with unpacked(path) as plain:
        for kind in ("extxyz", "xyz"):
            try:
                atoms = ase.io.read(str(plain), index=0, format=kind)
                return Particles(atoms.positions, atoms.get_chemical_symbols())
            except Exception as error:
                reason = error
    raise Refused(f"ASE: {reason}")


def by_ase_dump(path):
    import ase.io

    if " xs ys zs" in text_of(path):
        raise Refused("ASE ignores the origin of the box for scaled positions")
    with unpacked(path) as plain:
        try:
            atoms = ase.io.read(str(plain), index=0, format="lammps-dump-text")
        except Exception as error:
            raise Refused(f"ASE: {error}")
    return Particles(atoms.positions)


def by_ase_data(path):
    import ase.io
    import ase.io.lammpsdata

    options = {}
    if "read_image_flags" in inspect.signature(ase.io.lammpsdata.read_lammps_data).parameters:
        options["read_image_flags"] = False  # Triptych draws atoms inside the box, at the positions in the file.
    style = "atomic"
    for line in text_of(path).splitlines():
        if line.strip().startswith("Atoms"):
            style = line.partition("#")[2].strip() or style
    with unpacked(path) as plain:
        try:
            atoms = ase.io.read(str(plain), format="lammps-data", style=style, **options)
        except Exception as error:
            raise Refused(f"ASE: {error}")
    return Particles(atoms.positions)


def by_hand_mmpld(path):
    """Reads only MMPLD files from generated_files, which contain one list with float positions and radii."""
    data = path.read_bytes()
    if data[:6] != b"MMPLD\0" or len(data) < 120:
        raise Refused("not a kind of MMPLD that the simple reader supports")
    parsed = generated_files.parse_mmpld(data)
    if parsed is None:
        raise Refused("not a kind of MMPLD that the simple reader supports")
    return Particles(parsed[:, :3], radii=parsed[:, 3])


def by_teem_or_hand_nrrd(path):
    return Volume(*generated_files.parse_nrrd(path, Refused))


def by_nibabel(path):
    import nibabel

    header = decompressed(path.read_bytes())[:348]
    if header[344:346] == b"n+" and header[108:112] == bytes(4):
        raise Refused("nibabel reads the header as voxels if vox_offset is 0")
    try:
        image = nibabel.load(str(path))
        data = np.asanyarray(image.dataobj)
    except Exception as error:
        raise Refused(f"nibabel: {error}")
    if data.dtype.fields:
        data = data[data.dtype.names[0]]
    while data.ndim > 3:
        data = data[..., 0]
    return Volume(data.T, [z or 1 for z in image.header.get_zooms()[:3]])


def by_vtk(path, name, all_points=True):
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy

    with unpacked(path) as plain:
        reader = getattr(vtk, name)()
        errors = []
        reader.AddObserver("ErrorEvent", lambda *_: errors.append(1))
        vtk.vtkObject.GlobalWarningDisplayOff()
        reader.SetFileName(str(plain))
        reader.Update()
        image = reader.GetOutput()
        if errors or image is None or image.GetNumberOfPoints() == 0:
            raise Refused("VTK reports an error")
        data = image.GetPointData()
        sizes = image.GetDimensions()
        array = data.GetScalars() or data.GetVectors() or data.GetArray(0)
        if array is None:
            array = image.GetCellData().GetScalars() or image.GetCellData().GetArray(0)
            sizes = [max(n - 1, 1) for n in sizes]
        if array is None:
            raise Refused("VTK does not find an array")
        values = vtk_to_numpy(array)
        values = values[:, 0] if values.ndim > 1 else values
        return Volume(values.reshape(sizes[::-1]), image.GetSpacing())


def by_vtk_metaimage(path):
    head = path.read_bytes()[:4096].decode("latin-1").lower()
    if "compresseddata = true" in head and "compresseddatasize" not in head:
        raise Refused("VTK needs CompressedDataSize")
    if "ndims = 4" in head:
        raise Refused("VTK does not read a fourth dimension")
    if "elementsize" in head and "elementspacing" in head:
        raise Refused("VTK reads a single voxel if both sizes are given")
    return by_vtk(path, "vtkMetaImageReader")


def by_hand_dat(path):
    return Volume(*generated_files.parse_dat(path, Refused))


# For each file-name extension in Triptych's tables: the kind of data, the second reader, and its Debian package.
READERS = {
    ".pdb": ("particles", by_gemmi_pdb, "python3-gemmi"),
    ".cif": ("particles", by_gemmi_cif, "python3-gemmi"),
    ".pqr": ("particles", by_mdanalysis_pqr, "python3-mdanalysis"),
    ".gro": ("particles", by_mdanalysis_gro, "python3-mdanalysis"),
    ".xyz": ("particles", by_ase_xyz, "python3-ase"),
    ".lammpstrj": ("particles", by_ase_dump, "python3-ase"),
    ".data": ("particles", by_ase_data, "python3-ase"),
    ".mmpld": ("particles", by_hand_mmpld, "python3-numpy"),
    ".nrrd": ("volume", by_teem_or_hand_nrrd, "teem-apps, else python3-numpy"),
    ".nii": ("volume", by_nibabel, "python3-nibabel"),
    ".mha": ("volume", by_vtk_metaimage, "python3-vtk9"),
    ".vti": ("volume", lambda path: by_vtk(path, "vtkXMLImageDataReader"), "python3-vtk9"),
    ".vtk": ("volume", lambda path: by_vtk(path, "vtkStructuredPointsReader"), "python3-vtk9"),
    ".dat": ("volume", by_hand_dat, "python3-numpy"),
}
SAME_AS = {
    ".ent": ".pdb", ".pdb1": ".pdb", ".mmcif": ".cif", ".extxyz": ".xyz", ".dump": ".lammpstrj",
    ".lmp": ".data", ".nhdr": ".nrrd", ".hdr": ".nii", ".mhd": ".mha",
}  # fmt: skip


def ending_of(path):
    name = path.name.lower()
    for packed in (".gz", ".bz2"):
        name = name.removesuffix(packed)
    ending = pathlib.PurePath(name).suffix
    return SAME_AS.get(ending, ending)


def text_of(path):
    data = path.read_bytes()
    return decompressed(data).decode("utf-8", "replace")


def decompressed(data):
    if data[:2] == b"\x1f\x8b":
        return gzip.decompress(data)
    return bz2.decompress(data) if data[:3] == b"BZh" else data


class unpacked:
    """Creates an uncompressed copy of a file, for readers that cannot read compressed files."""

    def __init__(self, path):
        self.path = path

    def __enter__(self):
        self.folder = None
        if self.path.suffix not in (".gz", ".bz2"):
            return self.path
        self.folder = tempfile.TemporaryDirectory()
        plain = pathlib.Path(self.folder.name) / self.path.stem
        plain.write_bytes(decompressed(self.path.read_bytes()))
        return plain

    def __exit__(self, *_):
        if self.folder:
            self.folder.cleanup()


def by_triptych(program, kind, path, out):
    done = subprocess.run([program, kind, str(path), "0", out], capture_output=True, timeout=600)
    if done.returncode != 0:
        raise Refused(done.stderr.decode("utf-8", "replace").strip() or f"exit {done.returncode}")
    return json.loads(done.stdout)


def sorted_rows(places, *others):
    order = np.lexsort(places.astype(np.float32).T[::-1])
    return [places[order]] + [np.asarray(other)[order] for other in others]


def difference_of_particles(facts, out, second):
    spheres = np.fromfile(out, np.float32).reshape(-1, 4)
    colours = np.fromfile(out + ".rgba8", np.uint32)
    if len(spheres) + facts["dropped"] != len(second.places):
        return f"count {len(spheres)} + {facts['dropped']} dropped, expected {len(second.places)}"
    if facts["dropped"]:
        return None
    elements = second.elements or [""] * len(spheres)
    ours, colours, radii = sorted_rows(spheres[:, :3].astype(float), colours, spheres[:, 3])
    theirs, elements = sorted_rows(second.places, elements)
    # MDAnalysis stores positions in single precision, so each of the two readers may be off by one ulp.
    if not np.allclose(ours, theirs, rtol=3e-7, atol=2e-6):
        return f"places differ by up to {np.abs(ours - theirs).max():.3g}"
    if second.radii is not None:
        theirs_radii = sorted_rows(second.places, second.radii)[1]
        if not np.allclose(radii, theirs_radii, rtol=3e-7):
            return "radii differ"
    if not second.elements:
        return None
    theirs_kinds = collections.Counter("H" if e in ("D", "T") else e for e in second.elements)
    ours_kinds = collections.Counter()
    for name, count in facts["kinds"].items():
        ours_kinds["H" if name in ("D", "T") else name] += count
    if ours_kinds != theirs_kinds:
        return f"elements {dict(ours_kinds)}, expected {dict(theirs_kinds)}"
    return None


def difference_of_volumes(facts, out, second):
    sizes = list(second.values.shape[::-1])
    if facts["size"] != sizes:
        return f"sizes {facts['size']}, expected {sizes}"
    if not np.allclose(facts["spacing"], second.spacing, rtol=1e-6):
        return f"spacing {facts['spacing']}, expected {list(second.spacing)}"
    ours = np.fromfile(out, float)
    theirs = second.values.ravel()
    # Scaled values are rounded to single precision. Colours in text files have only six digits.
    coarse = any("255·stored" in note for note in facts["notes"])
    if not np.allclose(ours, theirs, rtol=1e-6, atol=1e-3 if coarse else 0, equal_nan=True):
        return f"values differ by up to {np.nanmax(np.abs(ours - theirs)):.3g}"
    return None


class Tally:
    def __init__(self, listing):
        self.counts = collections.defaultdict(collections.Counter)
        self.different = []
        self.missing = set()
        self.listing = listing

    def add(self, ending, outcome, path, reason=""):
        self.counts[ending][outcome] += 1
        if outcome == "differ":
            self.different.append((path, reason))
        elif self.listing and outcome != "agree":
            print(f"{outcome}: {path}: {reason}")

    def print(self):
        columns = ["agree", "agree, no element stated", "refused by Triptych", "refused by the second",
                   "refused by both", "differ"]  # fmt: skip
        print(f"{'format':<12}" + "".join(f"{c:>26}" for c in columns))
        for ending in sorted(self.counts):
            print(f"{ending:<12}" + "".join(f"{self.counts[ending][c]:>26}" for c in columns))
        for package in sorted(self.missing):
            print(f"not compared: {package} is not installed")
        for path, reason in self.different:
            print(f"DIFFERENT {path}: {reason}")


def compare(program, path, tally, out):
    ending = ending_of(path)
    if ending not in READERS:
        return
    kind, reader, package = READERS[ending]
    second = ours = ours_reason = second_reason = None
    try:
        second = reader(path)
    except ImportError:
        tally.missing.add(f"{package} ({ending})")
        return
    except Refused as refused:
        second_reason = str(refused)
    except Exception as error:
        second_reason = f"{type(error).__name__}: {error}"
    try:
        ours = by_triptych(program, kind, path, out)
    except Refused as refused:
        ours_reason = str(refused)
    if ours is None or second is None:
        who = "both" if ours is second is None else "Triptych" if ours is None else "the second"
        tally.add(ending, f"refused by {who}", path, ours_reason or second_reason)
        return
    if kind == "particles":
        reason = difference_of_particles(ours, out, second)
        agreed = "agree" if second.elements else "agree, no element stated"
    else:
        reason = difference_of_volumes(ours, out, second)
        agreed = "agree"
    tally.add(ending, "differ" if reason else agreed, path, reason or "")


def seeds_as_files(folder):
    """Converts fuzzer inputs, whose first line is the file-name extension, to files with that extension."""
    root = pathlib.Path(__file__).resolve().parents[1] / "fuzz" / "seeds"
    folders = [root / "particles", root / "volumes"]
    # Includes the inputs that fuzzers have saved in this checkout.
    corpus = root.parents[2] / "build" / "fuzz" / "corpus"
    folders += [corpus / "particles", corpus / "volumes"]
    for source in folders:
        for index, seed in enumerate(sorted(source.glob("*"))):
            ending, _, content = seed.read_bytes().partition(b"\n")
            if b"/" in ending or len(ending) > 20:
                continue
            name = f"{source.parent.name}_{index}.{ending.decode('ascii', 'replace')}"
            (folder / name).write_bytes(content)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--program", required=True)
    parser.add_argument("--generate", type=pathlib.Path)
    parser.add_argument("--list", action="store_true", help="print every file that is refused")
    parser.add_argument("paths", nargs="*", type=pathlib.Path)
    arguments = parser.parse_args()
    paths = list(arguments.paths)
    tally = Tally(arguments.list)
    with tempfile.TemporaryDirectory() as scratch:
        if arguments.generate:
            arguments.generate.mkdir(parents=True, exist_ok=True)
            variants = arguments.generate / "variants"
            variants.mkdir(exist_ok=True)
            generated_files.write_all(arguments.generate)
            generated_variants.write_all(variants)
            paths.append(arguments.generate)
            seeds = pathlib.Path(scratch) / "seeds"
            seeds.mkdir()
            seeds_as_files(seeds)
            paths.append(seeds)
        out = str(pathlib.Path(scratch) / "values")
        for path in paths:
            files = sorted(p for p in path.rglob("*") if p.is_file()) if path.is_dir() else [path]
            for file in files:
                compare(arguments.program, file, tally, out)
    tally.print()
    agreed = sum(counts["agree"] for counts in tally.counts.values())
    if tally.different:
        return 1
    return 0 if agreed else 77


if __name__ == "__main__":
    sys.exit(main())
