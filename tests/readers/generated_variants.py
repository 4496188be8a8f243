"""Writes files with features that readers often handle wrongly: line ends, wrapped numbers, optional columns, unusual
headers. Each function writes the files of one format. A file passes if Triptych and the second reader agree on its
contents, or if either of them rejects it.
"""

import bz2
import gzip
import struct
import zlib

import numpy as np

RANDOM = np.random.default_rng(520)


def pdb_line(name, residue, place, element="", record="ATOM  ", serial=1, number=1, alt=" ", code=" ", tail=None):
    line = (f"{record}{serial:>5} {name:<4}{alt}{residue:>3} A{number:>4}{code}   "
            f"{place[0]:8.3f}{place[1]:8.3f}{place[2]:8.3f}")  # fmt: skip
    return line + (tail if tail is not None else f"  1.00 10.00          {element:>2}")


def write_pdb(folder):
    def write(name, lines, end="\n", encoding="utf-8"):
        (folder / f"{name}.pdb").write_bytes(end.join(lines).encode(encoding) + end.encode())

    places = np.round(RANDOM.uniform(-99, 99, size=(6, 3)), 3)
    names = [(" N  ", "N"), (" CA ", "C"), (" C  ", "C"), (" O  ", "O"), (" CB ", "C"), (" SG ", "S")]
    atoms = [pdb_line(n, "CYS", p, e, serial=i + 1) for i, ((n, e), p) in enumerate(zip(names, places))]
    write("line_ends", atoms + ["END"], "\r\n")
    write("bom_and_line_ends", atoms + ["END"], "\r\n", "utf-8-sig")
    write("no_end", atoms)
    write("ter_only", atoms + ["TER", "CONECT    1    2", "MASTER        0"])
    write("lower_case_elements", [a[:76] + a[76:78].lower() for a in atoms] + ["END"])
    write("charges", [a + "1-" for a in atoms] + ["END"])
    write("trimmed", [a[:54] for a in atoms] + ["END"])
    write("hybrid_36", [pdb_line(n, "CYS", p, e, serial=f"A000{i}", number=f"A00{i}")
                        for i, ((n, e), p) in enumerate(zip(names, places))] + ["END"])  # fmt: skip
    write("stars", [pdb_line(n, "CYS", p, e, serial="*****", number="****")
                    for (n, e), p in zip(names, places)] + ["END"])  # fmt: skip
    write("alternatives", [pdb_line(n, "CYS", p + k / 8, e, alt="AB"[k])
                           for (n, e), p in zip(names, places) for k in (0, 1)] + ["END"])  # fmt: skip
    write("insertions", [pdb_line(n, "CYS", p, e, code="A") for (n, e), p in zip(names, places)] + ["END"])
    write("full_columns", [pdb_line(n, "CYS", -999 - p / 1000, e) for (n, e), p in zip(names, places)] + ["END"])
    write("deuterium", [pdb_line(" D1 ", "DOD", p, "D", "HETATM") for p in places] + ["END"])
    write("other_records", ["HEADER    X", "REMARK 350 ATOM", "CRYST1   10.000   10.000   10.000  90.00  90.00  90.00 P 1"]
          + [x for a in atoms for x in (a, "ANISOU" + a[6:28] + "     10     10     10      0      0      0" + a[70:])]
          + ["END"])  # fmt: skip
    write("models", ["MODEL        1", *atoms, "ENDMDL", "MODEL        2", *atoms[:3], "ENDMDL", "END"])
    write("models_without_ends", ["MODEL        1", *atoms, "MODEL        2", *atoms[:3], "END"])
    write("blank_lines", [x for a in atoms for x in (a, "")] + ["END"])
    write("long_lines", [a + "  " + "x" * 100 for a in atoms] + ["END"])
    ions = [("CA  ", " CA", "CA"), ("NA  ", " NA", "NA"), ("ZN  ", " ZN", "ZN"), ("FE  ", "HEM", "FE"),
            ("SE  ", "MSE", "SE"), ("CL  ", " CL", "CL")]  # fmt: skip
    write("ions", [pdb_line(n, r, p, e, "HETATM") for (n, r, e), p in zip(ions, places)] + ["END"])
    write("four_letter_residues", [a[:17] + "TIP3" + a[21:] for a in atoms] + ["END"])
    (folder / "old_bzip2.ent.bz2").write_bytes(bz2.compress(("\n".join(atoms) + "\n").encode()))


def write_cif(folder):
    places = np.round(RANDOM.uniform(-99, 99, size=(5, 3)), 3)
    symbols = ["C", "N", "ZN", "O", "SE"]
    tags = ["group_PDB", "id", "type_symbol", "label_atom_id", "label_comp_id", "Cartn_x", "Cartn_y", "Cartn_z"]
    rows = [["HETATM", str(i + 1), s, f"{s}1", "LIG", *map(str, p)] for i, (p, s) in enumerate(zip(places, symbols))]

    def write(name, tags=tags, rows=rows, before="", after="#\n", sep=" ", end="\n", head="data_X\n#\nloop_\n"):
        text = head + "".join(f"_atom_site.{t}\n" for t in tags) + "".join(sep.join(r) + "\n" for r in rows)
        (folder / f"{name}.cif").write_bytes((before + text + after).replace("\n", end).encode())

    write("plain")
    write("line_ends", end="\r\n")
    write("tabs", sep="\t")
    write("rows_over_lines", sep="\n")
    write("reversed_columns", tags[::-1], [r[::-1] for r in rows])
    write("upper_case_words", [t.upper() for t in tags], head="DATA_X\nLOOP_\n")
    write("uncertainties", rows=[r[:5] + [v + "(12)" for v in r[5:]] for r in rows])
    write("quoted", rows=[r[:3] + [f"'{r[3]}''x'", '"LI\'G"'] + r[5:] for r in rows])
    write("comments_inside", rows=[x for r in rows for x in (r, ["# a comment _atom_site.id"])])
    write("text_before", before="data_A\n_a.b\n;loop_\n_atom_site.id\n1\n;\n")
    write("two_blocks", before="data_A\n_cell.length_a 5\n")
    write("text_in_a_row", rows=[r[:3] + ["\n;a\nb\n;\n"] + r[4:] for r in rows])
    write("unknown_place", rows=[rows[0], rows[1][:5] + ["?"] + rows[1][6:]])
    write("no_symbols", rows=[r[:2] + ["?"] + r[3:] for r in rows])
    write("lower_case_symbols", rows=[r[:2] + [r[2].lower()] + r[3:] for r in rows])
    write("charged_symbols", rows=[r[:2] + [r[2] + "2+"] + r[3:] for r in rows])
    write("models_mixed", tags + ["pdbx_PDB_model_num"], [r + [str(1 + i % 2)] for i, r in enumerate(rows)])
    write("second_model_first", tags + ["pdbx_PDB_model_num"], [r + [str(2 - i % 2)] for i, r in enumerate(rows)])
    write("loop_after", after="loop_\n_b.c\n_b.d\n1 2\n3 4\n")
    write("exponents", rows=[r[:5] + [f"{float(v):.6e}" for v in r[5:]] for r in rows])
    write("missing_value", rows=rows[:-1] + [rows[-1][:-1]])
    write("cif_2", before="#\\#CIF_2.0\n")
    write("save_frame", before="data_D\nsave_a\n_x.y 1\nsave_\n")


def write_gro(folder):
    places = np.round(RANDOM.uniform(-9, 9, size=(4, 3)), 3)

    def write(name, title="made", count="4", box="   5.00000   5.00000   5.00000", names=None, end="\n",
              decimals=3, velocities=False, more="", residue="LIG  "):  # fmt: skip
        rows = [
            f"{1:5d}{residue:<5}{(names or ['C1', 'N1', 'O1', 'C2'])[i]:>5}{i + 1:5d}"
            + "".join(f"{v:{decimals + 5}.{decimals}f}" for v in p)
            + ("  0.1000 -0.2000  0.3000" if velocities else "")
            for i, p in enumerate(places)
        ]
        text = "\n".join([title, count, *rows, box]) + "\n" + more
        (folder / f"{name}.gro").write_bytes(text.replace("\n", end).encode())

    write("plain")
    write("line_ends", end="\r\n")
    write("velocities", velocities=True)
    write("time_in_title", title="Water t=   1.00000 step= 5")
    write("empty_title", title="")
    write("title_of_digits", title="12")
    write("blanks_around_count", count="   4   ")
    write("triclinic", box=" ".join(["5.00000"] * 3 + ["0.00000"] * 6))
    write("huge_box", box="1000.000001000.000001000.00000")
    write("names_that_touch", names=["C1234", "N1234", "O1234", "H1234"], residue="LIGND")
    for decimals in (1, 2, 4, 5, 8):
        write(f"decimals_{decimals}", decimals=decimals)
    write("blank_lines_after", more="\n\n")
    write("too_many_lines", count="3")
    write("too_few_lines", count="5")
    write("negative_count", count="-4")
    write("second_frame", more=(folder / "plain.gro").read_text())
    write("no_box", box="")
    write("umlaut", title="Größe")
    (folder / "packed.gro.gz").write_bytes(gzip.compress((folder / "plain.gro").read_bytes()))


def write_xyz(folder):
    places = np.round(RANDOM.uniform(-9, 9, size=(4, 3)), 3)
    symbols = ["C", "N", "Cl", "H"]

    def write(name, count="4", comment="made", rows=None, more="", end="\n", ending="xyz"):
        rows = rows or [f"{s} {p[0]} {p[1]} {p[2]}" for s, p in zip(symbols, places)]
        text = "\n".join([count, comment, *rows]) + "\n" + more
        (folder / f"{name}.{ending}").write_bytes(text.replace("\n", end).encode())

    def rows(text, symbols=symbols):
        return [text.format(s=s, x=p[0], y=p[1], z=p[2]) for s, p in zip(symbols, places)]

    write("plain")
    write("line_ends", end="\r\n")
    write("tabs", rows=rows("{s}\t{x}\t{y}\t{z}"))
    write("leading_blanks", count="   4", rows=rows("   {s}   {x} {y} {z}   "))
    write("empty_comment", comment="")
    write("more_columns", rows=rows("{s} {x} {y} {z} 0.5 -0.5 1.5"))
    write("upper_case", rows=rows("{s} {x} {y} {z}", ["C", "N", "CL", "H"]))
    write("lower_case", rows=rows("{s} {x} {y} {z}", ["c", "n", "cl", "h"]))
    write("atomic_numbers", rows=rows("{s} {x} {y} {z}", ["6", "7", "17", "1"]))
    write("labels", rows=rows("{s} {x} {y} {z}", ["C1", "N2", "Cl3", "H4"]))
    write("blank_lines_after", more="\n \n\n")
    write("frames", more=(folder / "plain.xyz").read_text())
    write("words_after_count", count="4 atoms")
    write("too_few", count="5")
    write("no_number", rows=rows("{s} {x} {y} nan"))

    def extended(name, properties, form, comment="{}"):
        write(name, comment=comment.format(f"Properties={properties}"), rows=rows(form), ending="extxyz")

    extended("ext_plain", "species:S:1:pos:R:3", "{s} {x} {y} {z}", 'Lattice="9 0 0 0 9 0 0 0 9" {}')
    extended("ext_order", "pos:R:3:species:S:1", "{x} {y} {z} {s}")
    extended("ext_forces_first", "forces:R:3:species:S:1:pos:R:3", "1 2 3 {s} {x} {y} {z}")
    extended("ext_ids", "id:I:1:species:S:1:pos:R:3:mass:R:1", "7 {s} {x} {y} {z} 12.0")
    extended("ext_flags", "species:S:1:pos:R:3:move_mask:L:3", "{s} {x} {y} {z} T F T")
    extended("ext_quotes", "species:S:1:pos:R:3", "{s} {x} {y} {z}", 'config="a Properties=pos:R:3 b" {} pbc="T T T"')
    extended("ext_quoted_value", '"species:S:1:pos:R:3"', "{s} {x} {y} {z}")
    extended("ext_arrays", "species:S:1:pos:R:3", "{s} {x} {y} {z}", 'a={{1 2 3}} b=[1,2,3] {} c="[[1,2],[3,4]]"')
    extended("ext_bare_key", "species:S:1:pos:R:3", "{s} {x} {y} {z}", "flag {} other=T")
    extended("ext_last", "species:S:1:pos:R:3", "{s} {x} {y} {z}", "energy=-1.5e3 pbc=T {}")
    extended("ext_no_species", "pos:R:3:charge:R:1", "{x} {y} {z} 0.5")
    extended("ext_no_pos", "species:S:1:forces:R:3", "{s} {x} {y} {z}")
    extended("ext_too_few_columns", "species:S:1:pos:R:3:charge:R:1", "{s} {x} {y} {z}")


def write_lammps(folder):
    places = np.round(RANDOM.uniform(-9, 9, size=(4, 3)), 3)

    def dump(name, columns, form, box="-10 10\n-10 10\n-10 10", bounds="pp pp pp", head="", more=""):
        rows = [form.format(i=i + 1, t=1 + i % 2, e="CN"[i % 2], x=p[0], y=p[1], z=p[2]) for i, p in enumerate(places)]
        text = (f"{head}ITEM: TIMESTEP\n100\nITEM: NUMBER OF ATOMS\n4\nITEM: BOX BOUNDS {bounds}\n{box}\n"
                f"ITEM: ATOMS {columns}\n" + "\n".join(rows) + "\n")  # fmt: skip
        (folder / f"{name}.lammpstrj").write_text(text + more)
        return text

    text = dump("dump_plain", "id type x y z", "{i} {t} {x} {y} {z}")
    dump("dump_frames", "id type x y z", "{i} {t} {x} {y} {z}", more=text.replace("100", "200", 1))
    dump("dump_order", "z type y id x", "{z} {t} {y} {i} {x}")
    dump("dump_unwrapped", "id type xu yu zu", "{i} {t} {x} {y} {z}")
    dump("dump_elements", "id element x y z", "{i} {e} {x} {y} {z}")
    dump("dump_more", "id type q x y z ix iy iz vx c_pe[1]", "{i} {t} 0.5 {x} {y} {z} 1 0 -1 2.5 3.5")
    dump("dump_triclinic", "id type x y z", "{i} {t} {x} {y} {z}", "-10 12 2\n-10 10 0\n-10 10 0", "xy xz yz pp pp pp")
    dump("dump_units", "id type x y z", "{i} {t} {x} {y} {z}", head="ITEM: UNITS\nreal\nITEM: TIME\n5\n")
    dump("dump_blanks", "id type x y z ", "{i} {t} {x} {y} {z} ")
    dump("dump_no_places", "id type vx vy vz", "{i} {t} {x} {y} {z}")
    dump("dump_mixed", "id type x yu z", "{i} {t} {x} {y} {z}")

    def data(name, style, form, before="", after="", hint=True, head="2 atom types\n"):
        rows = [form.format(i=i + 1, t=1 + i % 2, x=p[0], y=p[1], z=p[2]) for i, p in enumerate(places)]
        text = (f"made\n\n4 atoms\n{head}\n-10 10 xlo xhi\n-10 10 ylo yhi\n-10 10 zlo zhi\n\n{before}"
                f"Atoms{f' # {style}' if hint else ''}\n\n" + "\n".join(rows) + f"\n{after}")  # fmt: skip
        (folder / f"{name}.data").write_text(text)

    masses = "Masses\n\n1 12.0 # C\n2 14.0 # N\n\n"
    data("data_atomic", "atomic", "{i} {t} {x} {y} {z}", masses)
    data("data_images", "atomic", "{i} {t} {x} {y} {z} 0 -1 2", masses)
    data("data_charge", "charge", "{i} {t} 0.5 {x} {y} {z}", masses)
    data("data_molecular", "molecular", "{i} 1 {t} {x} {y} {z}", masses)
    data("data_full", "full", "{i} 1 {t} -0.5 {x} {y} {z}", masses)
    data("data_full_images", "full", "{i} 1 {t} -0.5 {x} {y} {z} 0 0 0", masses)
    data("data_sphere", "sphere", "{i} {t} 1.0 2.5 {x} {y} {z}", masses)
    data("data_comments", "atomic", "{i} {t} {x} {y} {z} # an atom", masses)
    data("data_velocities", "atomic", "{i} {t} {x} {y} {z}", masses, "\nVelocities\n\n1 0 0 0\n2 0 0 0\n3 0 0 0\n4 0 0 0\n")
    data("data_velocities_first", "atomic", "{i} {t} {x} {y} {z}",
         masses + "Velocities\n\n1 9 9 9\n2 9 9 9\n3 9 9 9\n4 9 9 9\n\n")  # fmt: skip
    data("data_coefficients", "atomic", "{i} {t} {x} {y} {z}", masses + "Pair Coeffs # lj/cut\n\n1 0.1 3.0\n2 0.1 3.0\n\n")
    data("data_no_style", "", "{i} {t} {x} {y} {z}", masses, hint=False)
    data("data_tilt", "atomic", "{i} {t} {x} {y} {z}", masses, head="2 atom types\n0.5 0 0 xy xz yz\n")


def write_pqr(folder):
    places = np.round(RANDOM.uniform(-99, 99, size=(4, 3)), 3)

    def write(name, form, record="ATOM", end="\n", before=(), after=("TER", "END")):
        rows = [form.format(r=record, i=i + 1, x=p[0], y=p[1], z=p[2]) for i, p in enumerate(places)]
        (folder / f"{name}.pqr").write_bytes((end.join([*before, *rows, *after]) + end).encode())

    write("plain", "{r} {i} CA ALA A 1 {x} {y} {z} 0.1 1.9")
    write("no_chain", "{r} {i} CA ALA 1 {x} {y} {z} -0.1 1.9")
    write("line_ends", "{r} {i} CA ALA A 1 {x} {y} {z} 0.1 1.9", end="\r\n")
    write("hetero", "{r} {i} ZN ZN A 1 {x} {y} {z} 2.0 1.2", "HETATM")
    write("remarks", "{r} {i} CA ALA A 1 {x} {y} {z} 0.1 1.9", before=("REMARK   5 ATOM", "REMARK"))
    write("no_end", "{r} {i} CA ALA A 1 {x} {y} {z} 0.1 1.9", after=())
    write("radius_0", "{r} {i} H ALA A 1 {x} {y} {z} 0.1 0.0")
    write("negative_number", "{r} {i} CA ALA A -5 {x} {y} {z} 0.1 1.9")
    write("blanks", "{r}  {i}   CA   ALA A   1     {x:8.3f} {y:8.3f} {z:8.3f}  0.1000 1.9000")
    write("exponents", "{r} {i} CA ALA A 1 {x} {y} {z} 1e-1 1.9E+0")


def write_nrrd(folder):
    values = RANDOM.integers(0, 999, size=(4, 5, 6)).astype("<i2")
    raw = values.tobytes()
    usual = ["type: short", "dimension: 3", "sizes: 6 5 4", "endian: little", "encoding: raw", "spacings: 1 2 3"]

    def write(name, fields, data=raw, magic="NRRD0004", end="\n", ending="nrrd"):
        text = end.join([magic, *fields, "", ""])
        (folder / f"{name}.{ending}").write_bytes(text.encode() + data)

    def without(*names):
        return [f for f in usual if f.split(":")[0] not in names]

    write("plain", usual)
    write("line_ends", usual, end="\r\n")
    for version in (1, 2, 3, 5):
        write(f"version_{version}", usual, magic=f"NRRD000{version}")
    write("comments", ["# a comment", *usual[:3], "#type: float", *usual[3:], "key:=value: of a key"])
    write("upper_case", [f.upper() for f in usual])
    write("types_with_blanks", ["type: signed short int", *usual[1:]])
    write("more_fields", [*usual, "content: x", "old min: 0", "old max: 9", "number: 120", "thicknesses: nan nan 3",
                          'labels: "a" "b" "c"', "min: 0", "max: 999", "sample units: HU"])  # fmt: skip
    write("directions", [*without("spacings"), "space: left-posterior-superior",
                         "space directions: (0,1,0) (-2,0,0) (0,0,3)", "space origin: (5,6,7)"])  # fmt: skip
    write("directions_with_blanks", [*without("spacings"), "space dimension: 3",
                                     "space directions: ( 1 , 0 , 0 )  (0, 2, 0) (0 ,0,3)"])  # fmt: skip
    write("no_spacing", without("spacings"))
    write("one_voxel_axis", ["type: short", "dimension: 3", "sizes: 120 1 1", *usual[3:]])
    write("byte_skip", [*usual, "byte skip: 7"], b"1234567" + raw)
    write("skip_to_the_end", [*usual, "byte skip: -1"], b"1234567" + raw)
    write("line_skip", [*usual, "line skip: 2"], b"one\ntwo\n" + raw)
    write("packed_small_blocks", [*without("encoding"), "encoding: gz"], gzip.compress(raw[:50]) + gzip.compress(raw[50:]))
    write("bzip2", [*without("encoding"), "encoding: BZ2"], bz2.compress(raw))
    write("hex_upper_case", [*without("encoding"), "encoding: hex"], raw.hex().upper().encode() + b"\n")
    write("ascii_commas", [*without("encoding"), "encoding: ascii"], b",\n".join(str(v).encode() for v in values.ravel()))
    four = np.stack([values, values + 1])
    write("times_last", ["type: short", "dimension: 4", "sizes: 6 5 4 2", "kinds: domain domain domain time",
                         *usual[3:5], "spacings: 1 2 3 nan"], four.tobytes())  # fmt: skip
    write("vectors_first", ["type: short", "dimension: 4", "sizes: 2 6 5 4", "kinds: 2-vector space space space",
                            *usual[3:5], "space directions: none (1,0,0) (0,2,0) (0,0,3)", "space dimension: 3"],
          np.moveaxis(four, 0, -1).tobytes())  # fmt: skip
    write("too_short", usual, raw[:-1])


def write_nifti(folder):
    values = RANDOM.integers(0, 999, size=(4, 5, 6)).astype("<i2")

    def header(dims=(3, 6, 5, 4, 1, 1, 1, 1), code=4, bits=16, pixdim=(1, 1, 2, 3, 1, 1, 1, 1), offset=352.0,
               slope=0.0, intercept=0.0, magic=b"n+1\0", units=2, size=352):  # fmt: skip
        data = bytearray(size)
        struct.pack_into("<i", data, 0, 348)
        struct.pack_into("<8h", data, 40, *dims)
        struct.pack_into("<hh", data, 70, code, bits)
        struct.pack_into("<8f", data, 76, *pixdim)
        struct.pack_into("<3f", data, 108, offset, slope, intercept)
        data[123] = units
        data[344:348] = magic
        return bytes(data)

    def write(name, data=values.tobytes(), ending="nii", **fields):
        (folder / f"{name}.{ending}").write_bytes(header(**fields) + data)

    write("plain")
    write("extension", b"\x10\0\0\0\6\0\0\0comment." + values.tobytes(), offset=368.0)
    write("sform", pixdim=(-1, 1, 2, 3, 1, 1, 1, 1))
    write("negative_spacing", pixdim=(1, -1, 2, 3, 1, 1, 1, 1))
    write("spacing_of_zero", pixdim=(1, 0, 2, 3, 1, 1, 1, 1))
    write("slope_of_one", slope=1.0)
    write("slope_of_two", slope=2.0, intercept=-5.0)
    write("slope_of_zero", slope=0.0, intercept=7.0)
    write("slope_nan", slope=float("nan"), intercept=1.0)
    write("micrometres", units=3)
    write("two_dimensions", dims=(2, 6, 20, 0, 0, 0, 0, 0))
    write("zero_behind", dims=(3, 6, 5, 4, 0, 0, 0, 0))
    write("times", np.concatenate([values, values]).tobytes(), dims=(4, 6, 5, 4, 2, 1, 1, 1))
    write("vectors", np.concatenate([values, values, values]).tobytes(), dims=(5, 6, 5, 4, 1, 3, 1, 1))
    write("colours", RANDOM.integers(0, 255, size=360, dtype="uint8").tobytes(), code=128, bits=24)
    write("offset_of_zero", offset=0.0)
    write("too_short", values.tobytes()[:-1])
    write("longer", values.tobytes() + b"more")
    (folder / "pair.hdr").write_bytes(header(magic=b"ni1\0", offset=0.0, size=348))
    (folder / "pair.img").write_bytes(values.tobytes())
    (folder / "packed.nii.gz").write_bytes(gzip.compress(header() + values.tobytes()))


def write_metaimage(folder):
    values = RANDOM.integers(0, 999, size=(4, 5, 6)).astype("<i2")
    raw = values.tobytes()
    usual = ["ObjectType = Image", "NDims = 3", "BinaryData = True", "BinaryDataByteOrderMSB = False",
             "DimSize = 6 5 4", "ElementSpacing = 1 2 3", "ElementType = MET_SHORT"]  # fmt: skip

    def write(name, fields, data=raw, end="\n", last="ElementDataFile = LOCAL"):
        (folder / f"{name}.mha").write_bytes((end.join([*fields, last]) + end).encode() + data)

    write("plain", usual)
    write("line_ends", usual, end="\r\n")
    write("no_blanks", [f.replace(" = ", "=") for f in usual])
    write("comments", ["Comment = a = b", *usual])
    write("positions", [*usual[:4], "TransformMatrix = 1 0 0 0 1 0 0 0 1", "Offset = 1 2 3", "CenterOfRotation = 0 0 0",
                        "AnatomicalOrientation = RAI", *usual[4:]])  # fmt: skip
    write("element_size", [f.replace("ElementSpacing", "ElementSize") for f in usual])
    write("both_sizes", ["ElementSize = 9 9 9", *usual])
    write("big_by_another_name", [f.replace("BinaryDataByteOrderMSB = False", "ElementByteOrderMSB = True") for f in usual],
          values.byteswap().tobytes())  # fmt: skip
    write("channels", [*usual[:4], "ElementNumberOfChannels = 2", *usual[4:]], np.stack([values, values + 1], -1).tobytes())
    packed = zlib.compress(raw)
    write("packed", [*usual[:3], "CompressedData = True", f"CompressedDataSize = {len(packed)}", *usual[3:]], packed)
    write("packed_gzip", [*usual[:3], "CompressedData = True", f"CompressedDataSize = {len(gzip.compress(raw))}", *usual[3:]],
          gzip.compress(raw))  # fmt: skip
    write("ascii", [f.replace("BinaryData = True", "BinaryData = False") for f in usual],
          b" ".join(str(v).encode() for v in values.ravel()))  # fmt: skip
    write("two_dimensions", [f.replace("NDims = 3", "NDims = 2").replace("6 5 4", "6 20").replace("1 2 3", "1 2")
                             for f in usual])  # fmt: skip
    write("too_short", usual, raw[:-1])
    (folder / "skipped.raw").write_bytes(b"0123456789" + raw)
    for name, size in (("skipped", 10), ("skipped_from_the_end", -1)):
        (folder / f"{name}.mhd").write_text(
            "\n".join([*usual, f"HeaderSize = {size}", "ElementDataFile = skipped.raw", ""])
        )
    for z in range(4):
        (folder / f"slice{z}.raw").write_bytes(values[z].tobytes())
    (folder / "slices.mhd").write_text(
        "\n".join([*usual, "ElementDataFile = LIST", *(f"slice{z}.raw" for z in range(4)), ""])
    )


def write_vtk(folder):
    values = RANDOM.integers(0, 999, size=(4, 5, 6)).astype(">i2")
    text = " ".join(map(str, values.ravel())).encode()
    points = "POINT_DATA 120\nSCALARS v short 1\nLOOKUP_TABLE default\n"
    usual = "DATASET STRUCTURED_POINTS\nDIMENSIONS 6 5 4\nORIGIN 0 0 0\nSPACING 1 2 3\n"

    def write(name, head=usual, arrays=points, data=values.tobytes(), kind="BINARY", title="made", end="\n", version="3.0"):
        head = f"# vtk DataFile Version {version}\n{title}\n{kind}\n{head}{arrays}".replace("\n", end)
        (folder / f"{name}.vtk").write_bytes(head.encode() + data)

    write("plain")
    write("ascii", data=text, kind="ASCII")
    write("ascii_line_ends", data=text, kind="ASCII", end="\r\n")
    write("lower_case", usual.lower(), points.lower(), text, "ascii")
    write("aspect_ratio", usual.replace("SPACING", "ASPECT_RATIO"))
    write("other_order", "DATASET STRUCTURED_POINTS\nSPACING 1 2 3\nORIGIN 0 0 0\nDIMENSIONS 6 5 4\n")
    write("version_1", version="1.0")
    write("version_4", version="4.2")
    write("empty_title", title="")
    write("components", arrays="POINT_DATA 120\nSCALARS v short 2\nLOOKUP_TABLE default\n",
          data=np.stack([values, values + 1], -1).tobytes())  # fmt: skip
    write("no_count", arrays="POINT_DATA 120\nSCALARS v short\nLOOKUP_TABLE default\n")
    write("vectors", arrays="POINT_DATA 120\nVECTORS v short\n", data=np.stack([values] * 3, -1).tobytes())
    write("field", arrays="POINT_DATA 120\nFIELD FieldData 1\nv 1 120 short\n")
    write("two_arrays", arrays="POINT_DATA 120\nSCALARS v short 1\nLOOKUP_TABLE default\n",
          data=text + b"\nSCALARS w short 1\nLOOKUP_TABLE default\n" + text, kind="ASCII")  # fmt: skip
    write("cells", "DATASET STRUCTURED_POINTS\nDIMENSIONS 7 6 5\nORIGIN 0 0 0\nSPACING 1 2 3\n",
          "CELL_DATA 120\nSCALARS v short 1\nLOOKUP_TABLE default\n")  # fmt: skip
    write("too_short", data=values.tobytes()[:-1])
    write("other_count", arrays=points.replace("120", "119"))
    try:
        write_vti(folder, values)
    except ImportError:
        return


def write_vti(folder, values):
    import vtk
    from vtk.util.numpy_support import numpy_to_vtk

    def image(extent=(0, 5, 0, 4, 0, 3)):
        image = vtk.vtkImageData()
        image.SetExtent(*extent)
        image.SetSpacing(1, 2, 3)
        image.SetOrigin(-5, 1e3, 7)
        return image

    def array(values, name):
        made = numpy_to_vtk(values, deep=True)
        made.SetName(name)
        return made

    def write(name, image, mode="Appended", change=lambda text: text, compressor=None, block=None):
        writer = vtk.vtkXMLImageDataWriter()
        writer.SetInputData(image)
        getattr(writer, f"SetDataModeTo{mode}")()
        if compressor is None:
            writer.SetCompressorTypeToNone()
        else:
            writer.SetCompressorType(compressor)
        if block:
            writer.SetBlockSize(block)
        path = folder / f"{name}.vti"
        writer.SetFileName(str(path))
        writer.Write()
        path.write_bytes(change(path.read_bytes()))

    plain = values.astype("i2").ravel()
    shifted = image((2, 7, -3, 1, 10, 13))
    shifted.GetPointData().SetScalars(array(plain, "v"))
    write("shifted", shifted)
    small = image()
    small.GetPointData().SetScalars(array(plain, "v"))
    write("small_blocks", small, "Binary", compressor=vtk.vtkXMLWriter.ZLIB, block=128)
    write("lz4", small, compressor=vtk.vtkXMLWriter.LZ4)
    write("lzma", small, compressor=vtk.vtkXMLWriter.LZMA)
    write("ascii", small, "Ascii")
    write("line_ends", small, "Ascii", lambda text: text.replace(b"\n", b"\r\n"))
    write("single_quotes", small, "Ascii", lambda text: text.replace(b'"', b"'"))
    write("comment", small, "Ascii", lambda text: text.replace(b"<ImageData", b"<!-- <DataArray> -->\n<ImageData", 1))
    write("no_header_type", small, "Binary", lambda text: text.replace(b' header_type="UInt32"', b""))
    two = image()
    two.GetPointData().AddArray(array(plain + 1, "first"))
    two.GetPointData().SetScalars(array(plain, "second"))
    write("second_is_active", two)
    vectors = image()
    vectors.GetPointData().SetVectors(array(np.stack([plain, plain + 1, plain + 2], 1), "v"))
    write("vectors", vectors)
    cells = image((0, 6, 0, 5, 0, 4))
    cells.GetCellData().SetScalars(array(plain, "v"))
    write("cells", cells)
    flat = image((0, 5, 0, 19, 0, 0))
    flat.GetPointData().SetScalars(array(plain, "v"))
    write("one_slice", flat)
    reals = image()
    reals.GetPointData().SetScalars(array(np.where(plain % 7 == 0, 1e-30, plain / 3.0), "v"))
    write("reals_ascii", reals, "Ascii")
    write("reals_big", reals, "Appended")


def write_all(folder):
    for write in (write_pdb, write_cif, write_gro, write_xyz, write_lammps, write_pqr, write_nrrd, write_nifti,
                  write_metaimage, write_vtk):  # fmt: skip
        part = folder / write.__name__.removeprefix("write_")
        part.mkdir(exist_ok=True)
        write(part)
