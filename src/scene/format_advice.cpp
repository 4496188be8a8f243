#include "scene/format_advice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>

#include "scene/particle_formats.hpp"
#include "scene/text_lines.hpp"
#include "scene/volume_formats.hpp"

namespace triptych::scene {
namespace {

// An unsupported format, the closest supported format, and a command line that converts the file
// with a common program.
struct Conversion {
  std::string_view endings;
  std::string_view what;
  std::string_view to;
  std::string_view command;
};

constexpr std::array<Conversion, 14> particle_conversions{{
    {".xtc .trr .tng .tpr", "a GROMACS file", ".gro",
     "gmx trjconv -f IN.xtc -s RUN.tpr -o OUT.gro"},
    {".dcd .psf .crd .prmtop .parm7 .inpcrd .rst7 .nc .ncdf .mdcrd", "a CHARMM, NAMD or AMBER file",
     ".pdb",
     "python3 -c \"import MDAnalysis as m; "
     "m.Universe('TOPOLOGY','TRAJECTORY').atoms.write('OUT.pdb')\""},
    {".mol2 .sdf .mol .mdl .smi .cml .cdx", "a molecule", ".xyz", "obabel IN -O OUT.xyz"},
    {".pdbqt", "an AutoDock file", ".pdb", "obabel IN.pdbqt -O OUT.pdb"},
    {".bcif .mmtf", "a binary PDB structure", ".cif",
     "download the entry as mmCIF: https://files.rcsb.org/download/ID.cif"},
    {".mtz .mrc", "a file with reflections or a density map but no atoms", ".cif",
     "download the atomic model of the same structure"},
    {".poscar .contcar .vasp", "a VASP structure", ".extxyz", "ase convert -i vasp IN OUT.extxyz"},
    {".traj .db .cell .res .castep .xsf .in .gen .cfg .xml .json",
     "a structure file that ASE can read", ".extxyz", "ase convert IN OUT.extxyz"},
    {".gsd", "a HOOMD-blue file", ".xyz",
     "python3 -c \"import MDAnalysis as m; m.Universe('IN.gsd').atoms.write('OUT.xyz')\""},
    {".restart", "a LAMMPS restart file", ".data", "lmp -restart2data IN.restart OUT.data"},
    {".cube .cub", "a file with both atoms and a volume", ".xyz", "obabel IN.cube -O OUT.xyz"},
    {".ply .las .laz .pcd .pts", "a point cloud without radii", ".xyz",
     "write an .xyz file with the number of points, an empty line, and one line 'C x y z' per "
     "point"},
    {".csv .txt .npy", "a table", ".xyz",
     "write an .xyz file with the number of particles, an empty line, and one line 'ELEMENT x y z' "
     "per particle"},
    {".vtu .vtp .pvd", "a VTK mesh", ".xyz",
     "in ParaView: File, Save Data, as .csv; then write an .xyz file with the number of points, an "
     "empty line, and one line 'C x y z' per point"},
}};

constexpr std::array<Conversion, 14> volume_conversions{{
    {".dcm .dicom .ima", "one DICOM slice", ".nii", "dcm2niix -o . FOLDER"},
    {".mgz .mgh", "a FreeSurfer volume", ".nii.gz", "mri_convert IN.mgz OUT.nii.gz"},
    {".mnc", "a MINC volume", ".nii", "mnc2nii IN.mnc OUT.nii"},
    {".tif .tiff", "a TIFF stack", "raw voxels with explicit dimensions",
     "python3 -c \"import tifffile as t; a=t.imread('IN.tif'); print(a.shape[::-1], a.dtype); "
     "a.tofile('OUT.raw')\"; then use data=OUT.raw:XxYxZ:TYPE"},
    {".mrc .map .ccp4 .rec .st", "a density map", "raw voxels with explicit dimensions",
     "specify the dimensions and skip the 1024-byte header: data=IN.mrc:XxYxZ:f32:skip=1024"},
    {".npy .npz", "a NumPy array", "raw voxels with explicit dimensions",
     "python3 -c \"import numpy as n; a=n.load('IN.npy'); print(a.shape[::-1], a.dtype); "
     "a.tofile('OUT.raw')\"; then use data=OUT.raw:XxYxZ:TYPE"},
    {".h5 .hdf5 .hdf .nc .nc4 .bp", "an HDF5 or netCDF file", "raw voxels with explicit dimensions",
     "h5dump -d DATASET -b LE -o OUT.raw IN.h5; then use data=OUT.raw:XxYxZ:TYPE"},
    {".vtu .vtp .vts .vtr .vtm .pvd .pvti", "a VTK dataset that is not a single ImageData grid",
     ".vti", "in ParaView: Filters, Resample To Image; then File, Save Data, as .vti"},
    {".czi .lif .ims .oib .nd2 .lsm .stk", "a microscope file", ".nrrd",
     "in Fiji: File, Import, Bio-Formats; then File, Save As, Nrrd"},
    {".jpg .jpeg .png .bmp .jp2", "one slice", ".nrrd",
     "in Fiji: File, Import, Image Sequence; then File, Save As, Nrrd"},
    {".img", "the voxel file of an Analyze or NIfTI pair", ".hdr", "use the .hdr file next to it"},
    {".cube .cub .xplor .dx", "a density map from a chemistry program", ".nrrd",
     "in ChimeraX: open IN; save OUT.mrc; then use data=OUT.mrc:XxYxZ:f32:skip=1024"},
    {".pvm .vol .bov .raw .bin .img16 .yuv", "a voxel file whose dimensions must be specified",
     "raw voxels with explicit dimensions",
     "specify the dimensions as data=FILE:XxYxZ:TYPE, for example data=head.raw:256x256x128:u8"},
    {".fits .fit", "an astronomical image", "raw voxels with explicit dimensions",
     "python3 -c \"from astropy.io import fits; a=fits.getdata('IN.fits'); print(a.shape[::-1], "
     "a.dtype); a.astype('<f4').tofile('OUT.raw')\"; then use data=OUT.raw:XxYxZ:f32"},
}};

std::string conversion_text(std::string_view ending, std::span<const Conversion> conversions,
                            std::string_view endings) {
  const auto known = std::ranges::find_if(
      conversions, [&](const Conversion& each) { return has_ending(each.endings, ending); });
  if (known == conversions.end()) {
    return fmt::format("expected {}, plain or compressed with gzip or bzip2", endings);
  }
  return fmt::format("{} is {}; the nearest supported format is {}; to convert: {} (supported: {})",
                     ending, known->what, known->to, known->command, endings);
}

// The data that a suite reads.
struct ReadBySuite {
  std::string_view suite;
  std::string_view data;  // "volume" or "particle"
  std::span<const Conversion> conversions;
  std::string endings;
};

// Returns the format that the ending or the beginning of the content indicates, or nullptr.
template <typename Format>
const Format* find_format(std::span<const Format> formats, std::string_view ending,
                          std::string_view start) {
  const auto found = std::ranges::find_if(formats, [&](const Format& format) {
    return has_ending(format.endings, ending) || format.begins(start);
  });
  return found == formats.end() ? nullptr : &*found;
}

// `other` is the format of the other suite to which the file belongs, or nullptr.
template <typename Format>
std::string unknown_format(std::string_view ending, const ReadBySuite& read, const Format* other,
                           const ReadBySuite& other_read) {
  if (other != nullptr) {
    return fmt::format(
        "this looks like a {} file (format {}), which the suite {} does not read; use the suite "
        "{}, as in `triptych render {} --set data=FILE`",
        other_read.data, other->name, read.suite, other_read.suite, other_read.suite);
  }
  const std::string what =
      ending.empty() ? fmt::format(
                           "the file name has no extension, and the content does not "
                           "identify a {} format",
                           read.data)
                     : fmt::format("'{}' is not a known {} format", quotable(ending), read.data);
  return what + "; " + conversion_text(ending, read.conversions, read.endings);
}

template <typename Format>
std::string all_endings(std::span<const Format> formats) {
  std::string all;
  for (const Format& format : formats) {
    for (const std::string_view ending : split_words(format.endings)) {
      all += all.empty() ? "" : " ";
      all += ending;
    }
  }
  return all;
}

}  // namespace

bool has_ending(std::string_view endings, std::string_view ending) {
  const auto words = split_words(endings);
  return !ending.empty() && std::ranges::find(words, ending) != words.end();
}

std::string particle_endings() {
  return all_endings(particle_formats());
}

std::string volume_endings() {
  return all_endings(volume_formats());
}

std::string particle_advice(std::string_view ending, std::string_view start) {
  return unknown_format(ending, {"particles", "particle", particle_conversions, particle_endings()},
                        find_format(volume_formats(), ending, start), {"volume", "volume", {}, {}});
}

std::string volume_advice(std::string_view ending, std::string_view start) {
  return unknown_format(ending, {"volume", "volume", volume_conversions, volume_endings()},
                        find_format(particle_formats(), ending, start),
                        {"particles", "particle", {}, {}});
}

}  // namespace triptych::scene
