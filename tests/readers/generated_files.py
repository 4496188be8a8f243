"""Writes small files of every format and variant, and contains simple readers for formats that no library can read."""

import bz2
import gzip
import pathlib
import shutil
import struct
import subprocess
import tempfile

import numpy as np

RANDOM = np.random.default_rng(52)
TYPES = {
    "int8": "int8", "uint8": "uint8", "int16": "int16", "uint16": "uint16", "int32": "int32",
    "uint32": "uint32", "int64": "int64", "uint64": "uint64", "float": "float32", "double": "float64",
}  # fmt: skip


def values_of(dtype, shape=(4, 5, 6)):
    if np.dtype(dtype).kind == "f":
        return RANDOM.normal(size=shape).astype(dtype)
    info = np.iinfo(dtype)
    lo, hi = max(info.min, -(2**40)), min(info.max, 2**40)
    return RANDOM.integers(lo, hi, size=shape, dtype=np.int64, endpoint=True).astype(dtype)


# Particles

SYMBOLS = ["C", "N", "O", "S", "P", "Fe", "Cl", "Na"]


def atoms_of(count=40):
    places = np.round(RANDOM.uniform(-99, 99, size=(count, 3)), 3)
    return places, [SYMBOLS[i % len(SYMBOLS)] for i in range(count)]


def write_pdb(folder):
    places, symbols = atoms_of()

    def lines():
        for i, (p, s) in enumerate(zip(places, symbols)):
            name = f"{s.upper():>2}{i % 10:<2}"
            yield (f"HETATM{i + 1:5d} {name} LIG A{i % 9 + 1:4d}    {p[0]:8.3f}{p[1]:8.3f}{p[2]:8.3f}"
                   f"  1.00 10.00          {s.upper():>2}  ")  # fmt: skip

    body = "\n".join(lines()) + "\n"
    (folder / "plain.pdb").write_text(body + "END\n")
    (folder / "models.ent").write_text(
        f"MODEL        1\n{body}ENDMDL\nMODEL        2\n{body[:400]}\nENDMDL\nEND\n"
    )
    (folder / "packed.pdb.gz").write_bytes(gzip.compress((body + "END\n").encode()))


def write_cif(folder):
    places, symbols = atoms_of()
    head = "data_X\n#\nloop_\n" + "".join(
        f"_atom_site.{n}\n"
        for n in "group_PDB id type_symbol label_atom_id label_comp_id Cartn_x Cartn_y Cartn_z "
        "pdbx_PDB_model_num".split()
    )
    rows = [
        f"HETATM {i + 1} {s.upper()} \"{s}{i}'\" LIG {p[0]} {p[1]} {p[2]} {i % 2 + 1}"
        for i, (p, s) in enumerate(zip(places, symbols))
    ]
    (folder / "interleaved.cif").write_text(head + "\n".join(rows) + "\n#\n")
    (folder / "pairs.mmcif").write_text(
        "data_X\n_atom_site.type_symbol ZN\n_atom_site.Cartn_x 1.5\n_atom_site.Cartn_y 2.5\n"
        "_atom_site.Cartn_z 3.5\n"
    )


def write_gro(folder):
    places, symbols = atoms_of()
    for decimals in (3, 6):
        width = decimals + 5
        rows = [
            f"{1:5d}{'LIG':<5}{s.upper():>5}{i + 1:5d}"
            + "".join(f"{v / 10:{width}.{decimals}f}" for v in p)
            for i, (p, s) in enumerate(zip(places, symbols))
        ]
        (folder / f"decimals_{decimals}.gro").write_text(
            f"generated\n{len(rows):5d}\n" + "\n".join(rows) + "\n   20.00000   20.00000   20.00000\n"
        )


def write_xyz(folder):
    places, symbols = atoms_of()
    rows = [f"{s} {p[0]} {p[1]} {p[2]}" for p, s in zip(places, symbols)]
    plain = f"{len(rows)}\ngenerated\n" + "\n".join(rows) + "\n"
    (folder / "plain.xyz").write_text(plain)
    (folder / "two_frames.xyz").write_text(plain + plain)
    extended = [f"0.5 {p[1]} 7 8 9 {s} {p[0]} {p[1]} {p[2]} T" for p, s in zip(places, symbols)]
    comment = (
        'Lattice="9 0 0 0 9 0 0 0 9" note="a \\"quoted\\" word" '
        "Properties=charge:R:1:mass:R:1:forces:R:3:species:S:1:pos:R:3:fixed:L:1"
    )
    (folder / "columns.extxyz").write_text(f"{len(rows)}\n{comment}\n" + "\n".join(extended) + "\n")


def write_lammps(folder):
    places, _ = atoms_of()
    rows = [f"{i + 1} {i % 3 + 1} {p[0]} {p[1]} {p[2]}" for i, p in enumerate(places)]
    RANDOM.shuffle(rows)
    box = "-100 100\n-100 100\n-100 100\n"
    (folder / "dump.lammpstrj").write_text(
        f"ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n{len(rows)}\nITEM: BOX BOUNDS pp pp pp\n{box}"
        "ITEM: ATOMS id type x y z\n" + "\n".join(rows) + "\n"
    )
    limits = "-100 100 xlo xhi\n-100 100 ylo yhi\n-100 100 zlo zhi\n"
    head = f"generated\n\n{len(rows)} atoms\n3 atom types\n\n{limits}\nMasses\n\n1 1.0\n2 2.0\n3 3.0\n\n"
    (folder / "atomic.data").write_text(head + "Atoms # atomic\n\n" + "\n".join(rows) + "\n")
    charged = [" ".join(r.split()[:2] + ["0.5"] + r.split()[2:]) for r in rows]
    (folder / "charge.lmp").write_text(head + "Atoms # charge\n\n" + "\n".join(charged) + "\n")


def write_pqr(folder):
    places, symbols = atoms_of()
    rows = [
        f"ATOM {i + 1:6d} {s.upper():<4} LIG A {i % 9 + 1:3d} {p[0]:10.3f} {p[1]:10.3f} {p[2]:10.3f} "
        f"{0.1:8.4f} {1 + i / 100:7.4f}"
        for i, (p, s) in enumerate(zip(places, symbols))
    ]
    (folder / "plain.pqr").write_text("REMARK   1 generated\n" + "\n".join(rows) + "\nTER\nEND\n")


def write_mmpld(folder):
    spheres = RANDOM.uniform(1, 9, size=(20, 4)).astype("<f4")
    data = b"MMPLD\0" + struct.pack("<HI", 100, 1) + struct.pack("<6f", 0, 0, 0, 9, 9, 9)
    data += struct.pack("<6f", 0, 0, 0, 9, 9, 9)
    lists = struct.pack("<I", 1) + struct.pack("<BB", 2, 0) + struct.pack("<4B", 255, 255, 255, 255)
    lists += struct.pack("<Q", len(spheres)) + spheres.tobytes()
    start = len(data) + 16
    data += struct.pack("<QQ", start, start + len(lists))
    (folder / "spheres.mmpld").write_bytes(data + lists)


def parse_mmpld(data):
    """Returns the positions and radii in a file from write_mmpld, which contains one list. Returns None for other files."""
    version, frames = struct.unpack_from("<HI", data, 6)
    if version != 100 or frames != 1:
        return None
    start = struct.unpack_from("<Q", data, 60)[0]
    if start + 18 > len(data):
        return None
    lists, vertex, colour = struct.unpack_from("<IBB", data, start)
    if (lists, vertex, colour) != (1, 2, 0):
        return None
    count = struct.unpack_from("<Q", data, start + 10)[0]
    if len(data) != start + 18 + 16 * count:
        return None
    return np.frombuffer(data, "<f4", count * 4, start + 18).reshape(-1, 4)


# Volumes


def write_nrrd(folder):
    for name, dtype in TYPES.items():
        for endian, order in (("little", "<"), ("big", ">")):
            values = values_of(dtype)
            raw = values.astype(np.dtype(dtype).newbyteorder(order)).tobytes()
            head = (f"NRRD0004\ntype: {name}\ndimension: 3\nsizes: 6 5 4\nendian: {endian}\n"
                    "spacings: 1 2 3\n")  # fmt: skip
            (folder / f"{name}_{endian}.nrrd").write_bytes(f"{head}encoding: raw\n\n".encode() + raw)
    packed = {
        "gzip": gzip.compress(raw), "bzip2": bz2.compress(raw), "hex": raw.hex().encode(),
        "ascii": " ".join(repr(float(v)) for v in values.ravel()).encode(),
    }  # fmt: skip
    for encoding, data in packed.items():
        (folder / f"double_{encoding}.nrrd").write_bytes(f"{head}encoding: {encoding}\n\n".encode() + data)
    (folder / "detached.raw").write_bytes(raw)
    (folder / "detached.nhdr").write_text(f"{head}encoding: raw\ndata file: detached.raw\n")
    vectors = values_of("float32", (4, 5, 6, 3))
    (folder / "vectors.nrrd").write_bytes(
        b"NRRD0004\ntype: float\ndimension: 4\nsizes: 3 6 5 4\nendian: little\nencoding: raw\n"
        b"kinds: vector domain domain domain\nspacings: nan 1 2 3\n\n" + vectors.astype("<f4").tobytes()
    )


def write_nifti(folder):
    codes = {"uint8": 2, "int16": 4, "int32": 8, "float": 16, "double": 64, "int8": 256, "uint16": 512,
             "uint32": 768, "int64": 1024, "uint64": 1280}  # fmt: skip
    for name, code in codes.items():
        for order in "<>":
            values = values_of(TYPES[name])
            for version in (1, 2):
                head = nifti_header(version, order, [3, 6, 5, 4, 1, 1, 1, 1], code, values.itemsize * 8)
                raw = values.astype(values.dtype.newbyteorder(order)).tobytes()
                side = "little" if order == "<" else "big"
                (folder / f"{name}_{side}_{version}.nii").write_bytes(head + raw)
    head = nifti_header(1, "<", [3, 6, 5, 4, 1, 1, 1, 1], 4, 16, slope=0.25, intercept=-3)
    raw = values_of("int16").astype("<i2").tobytes()
    (folder / "scaled.nii.gz").write_bytes(gzip.compress(head + raw))
    head = nifti_header(1, "<", [4, 6, 5, 4, 3, 1, 1, 1], 16, 32)
    (folder / "times.nii").write_bytes(head + values_of("float32", (3, 4, 5, 6)).tobytes())


def nifti_header(version, order, dims, code, bits, slope=0.0, intercept=0.0):
    pixdim = [1, 1, 2, 3, 1, 1, 1, 1]
    if version == 1:
        data = bytearray(352)
        struct.pack_into(order + "i", data, 0, 348)
        struct.pack_into(order + "8h", data, 40, *dims)
        struct.pack_into(order + "hh", data, 70, code, bits)
        struct.pack_into(order + "8f", data, 76, *pixdim)
        struct.pack_into(order + "3f", data, 108, 352, slope, intercept)
        data[123] = 2
        data[344:348] = b"n+1\0"
        return bytes(data)
    data = bytearray(544)
    struct.pack_into(order + "i", data, 0, 540)
    data[4:12] = b"n+2\0\r\n\x1a\n"
    struct.pack_into(order + "hh", data, 12, code, bits)
    struct.pack_into(order + "8q", data, 16, *dims)
    struct.pack_into(order + "8d", data, 104, *pixdim)
    struct.pack_into(order + "q2d", data, 168, 544, slope, intercept)
    struct.pack_into(order + "i", data, 500, 2)
    return bytes(data)


def write_metaimage(folder):
    names = {"MET_UCHAR": "uint8", "MET_CHAR": "int8", "MET_USHORT": "uint16", "MET_SHORT": "int16",
             "MET_UINT": "uint32", "MET_INT": "int32", "MET_FLOAT": "float32",
             "MET_DOUBLE": "float64"}  # fmt: skip
    import zlib

    for name, dtype in names.items():
        values = values_of(dtype)
        for big in (False, True):
            raw = values.astype(values.dtype.newbyteorder(">" if big else "<")).tobytes()
            head = (f"ObjectType = Image\nNDims = 3\nDimSize = 6 5 4\nElementSpacing = 1 2 3\n"
                    f"BinaryDataByteOrderMSB = {big}\n")  # fmt: skip
            stem = f"{name.lower()}_{'big' if big else 'little'}"
            (folder / f"{stem}.mha").write_bytes(
                f"{head}ElementType = {name}\nElementDataFile = LOCAL\n".encode() + raw
            )
    packed = zlib.compress(raw)
    (folder / "packed.mha").write_bytes(
        f"{head}CompressedData = True\nCompressedDataSize = {len(packed)}\nElementType = {name}\n"
        "ElementDataFile = LOCAL\n".encode() + packed
    )
    (folder / "apart.raw").write_bytes(raw)
    (folder / "apart.mhd").write_text(f"{head}ElementType = {name}\nElementDataFile = apart.raw\n")


def write_vtk(folder):
    """Writes files with VTK's own writers, or nothing if VTK is not installed."""
    try:
        import vtk
        from vtk.util.numpy_support import numpy_to_vtk
    except ImportError:
        return
    for dtype in ("uint8", "int16", "uint16", "int32", "float32", "float64"):
        image = vtk.vtkImageData()
        image.SetDimensions(6, 5, 4)
        image.SetSpacing(1, 2, 3)
        array = numpy_to_vtk(values_of(dtype).ravel(), deep=True)
        array.SetName("values")
        image.GetPointData().SetScalars(array)
        for mode in ("Ascii", "Binary", "Appended"):
            for packed in (False, True):
                for order in ("LittleEndian", "BigEndian"):
                    writer = vtk.vtkXMLImageDataWriter()
                    writer.SetInputData(image)
                    getattr(writer, f"SetDataModeTo{mode}")()
                    writer.SetCompressorTypeToZLib() if packed else writer.SetCompressorTypeToNone()
                    getattr(writer, f"SetByteOrderTo{order}")()
                    writer.SetEncodeAppendedData(dtype == "uint8")
                    writer.SetHeaderTypeToUInt64() if packed else writer.SetHeaderTypeToUInt32()
                    name = f"{dtype}_{mode}_{packed}_{order}.vti".lower()
                    writer.SetFileName(str(folder / name))
                    writer.Write()
        for kind in ("ASCII", "Binary"):
            writer = vtk.vtkStructuredPointsWriter()
            writer.SetInputData(image)
            getattr(writer, f"SetFileTypeTo{kind}")()
            writer.SetFileName(str(folder / f"{dtype}_{kind.lower()}.vtk"))
            writer.Write()


def write_dat(folder):
    values = values_of("uint16")
    (folder / "big.raw").write_bytes(values.astype(">u2").tobytes())
    (folder / "big.dat").write_text(
        "ObjectFileName: big.raw\nResolution: 6 5 4\nSliceThickness: 1 2 3\nFormat: USHORT\n"
        "Endianness: BIG\n"
    )


def parse_dat(path, refused):
    fields = dict(line.lower().split(":", 1) for line in path.read_text().splitlines() if ":" in line)
    fields = {k.strip(): v.strip() for k, v in fields.items()}
    types = {"uchar": "u1", "char": "i1", "ushort": "u2", "short": "i2", "float": "f4", "double": "f8"}
    names = [v.split(":", 1)[1].strip() for v in path.read_text().splitlines()
             if v.lower().startswith("objectfilename")]  # fmt: skip
    raw = path.parent / (names[0] if names else "")
    if not raw.is_file():
        raise refused("its raw file is missing")
    order = ">" if fields.get("endianness", fields.get("endianess", "little")) == "big" else "<"
    sizes = [int(n) for n in fields["resolution"].split()]
    values = np.fromfile(raw, order + types[fields["format"]])
    spacing = [float(s) for s in fields.get("slicethickness", "1 1 1").split()]
    return values.reshape(sizes[::-1]), spacing


def parse_nrrd(path, refused):
    """Parses the header by hand. Decodes the values with Teem's program unu if it is installed, and otherwise by hand."""
    if path.suffix == ".gz":
        raise refused("Teem does not read compressed files")
    head = {}
    text = path.read_bytes().split(b"\n\n")[0].split(b"\r\n\r\n")[0].decode("latin-1")
    for line in text.splitlines()[1:]:
        if ":" in line and not line.startswith("#") and ":=" not in line:
            key, value = line.split(":", 1)
            head[key.strip().lower()] = value.strip()
    sizes = [int(n) for n in head["sizes"].split()]
    values = values_by_unu(path) if unu() else values_by_hand(path, head, refused)
    values = values.reshape(sizes[::-1])
    spacing = head.get("spacings", "1 1 1").split()
    if "space directions" in head:
        vectors = head["space directions"].replace(")", ") ").split(") ")
        vectors = [v.strip(" ()") for v in vectors if "," in v]
        spacing = [np.linalg.norm([float(c) for c in v.split(",")]) for v in vectors]
    spacing = [float(s) for s in spacing]
    if len(sizes) == 4:
        kinds = head.get("kinds", "").lower().split()
        axis = next((i for i, k in enumerate(kinds) if k not in ("domain", "space")), None)
        if axis is None:
            axis = sizes.index(1)
        values = np.take(values, 0, axis=3 - axis)
        spacing = spacing[:axis] + spacing[axis + 1 :] if len(spacing) == 4 else spacing
    elif len(sizes) != 3:
        raise refused("not three axes")
    return values, spacing


def unu():
    return shutil.which("unu") or shutil.which("teem-unu")


def values_by_unu(path):
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "out.nhdr"
        command = f"{unu()} convert -t double -i {path.name} | {unu()} save -e raw -f nrrd -en little -o {out}"
        done = subprocess.run(["sh", "-c", command], cwd=path.parent, capture_output=True)
        raw = out.with_suffix(".raw")
        if done.returncode != 0 or not raw.exists():
            raise ValueError(done.stderr.decode("utf-8", "replace").strip().replace("\n", "; ")[:200])
        return np.fromfile(raw, "<f8")


def values_by_hand(path, head, refused):
    data = path.read_bytes()
    start = data.find(b"\n\n")
    dtype = TYPES.get(head["type"].lower())
    if start < 0 or "data file" in head or dtype is None:
        raise refused("the simple reader supports only attached headers")
    data = data[start + 2 :]
    encoding = head["encoding"].lower()
    if encoding in ("gzip", "gz"):
        data = gzip.decompress(data)
    elif encoding in ("bzip2", "bz2"):
        data = bz2.decompress(data)
    elif encoding == "hex":
        data = bytes.fromhex(data.decode())
    elif encoding in ("ascii", "text", "txt"):
        return np.array(data.split(), float)
    return np.frombuffer(data, np.dtype(dtype).newbyteorder(">" if head.get("endian") == "big" else "<"))


def write_all(folder):
    for write in (write_pdb, write_cif, write_gro, write_xyz, write_lammps, write_pqr, write_mmpld,
                  write_nrrd, write_nifti, write_metaimage, write_vtk, write_dat):  # fmt: skip
        part = folder / write.__name__.removeprefix("write_")
        part.mkdir(exist_ok=True)
        write(part)
