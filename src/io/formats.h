// Lists all known file formats: supported formats, and others that errors can name. A new format needs a
// source file that defines the two functions declared here, and an entry in `formats`.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "io/numbers.h"
#include "io/readers.h"

namespace relievo::io {

// Return whether the file has this format. The content decides; if it does not show the format, the name
// decides. `source` may be only the beginning of a file.
bool is_ply(const Source& source);
bool is_pcd(const Source& source);
bool is_laz(const Source& source);
bool is_las(const Source& source);
bool is_e57(const Source& source);
bool is_splat(const Source& source);
bool is_npy_points(const Source& source);
bool is_gltf(const Source& source);
bool is_3mf(const Source& source);
bool is_off(const Source& source);
bool is_stl(const Source& source);
bool is_obj(const Source& source);
bool is_ptx(const Source& source);
bool is_text(const Source& source);

// Return the content of a file, with as many points as the file has; points that are left out become NaN.
// Errors: kind input. These parts of the formats are read:
//
// - PLY: ascii, binary little-endian and big-endian; x y z, nx ny nz and red green blue of any numeric type,
// in any order, among any other properties and elements. Of the other elements, `face` and `tristrips` are
// read, before or after the vertices. Each ascii row begins on a new line.
//   Vertices with opacity, f_dc, scale and rot are Gaussian splats. f_dc determines their colours; splats
//   that are less than half opaque are left out. The splats of a .splat file are read in the same way.
// - OBJ: v (also with weights and colours), vn and f, and the colours of ZBrush (#MRGB). The normal of a
// vertex is the mean of the normals that its faces refer to. If no face refers to a normal, the normal of a
// vertex is the vn with the same index. Faces may refer to normals that the file lacks. If vertices have no
// colours, they get those of the textures (map_Kd). A texture may have any format that is read as depths.
// - STL, binary and ascii: coincident corners are merged; the file's normals are ignored.
// - OFF, text and binary, with normals (NOFF) and colours (COFF).
// - glTF 2.0, .glb or .gltf, with buffers inside the file or beside it. The triangles and points of the scene
// are read, transformed by the scene's nodes or posed by their skins. A file without nodes gives the
// triangles and points of all meshes. Vertices without colours get those of the base colour texture. Numbers
// may be quantised, and compressed by EXT_meshopt_compression or KHR_meshopt_compression, but not by Draco.
// - 3MF: the meshes of the build, transformed as the build and components specify, with the colours of base
// materials and colour groups, but without textures. The file is the XML document in the archive; other
// documents are found beside it.
// - PCD: ascii (also with commas between the numbers), binary and binary_compressed; x y z, normal_x normal_y
// normal_z and rgb.
// - LAS 1.0 to 1.5, with colours. A file with fewer points than its header promises is read to its end. LAZ,
// which is LAS compressed by LASzip 2 or later, is read in the same way. Points of the classes 7 and 18
// (noise) and withheld points are left out.
// - E57: all scans with cartesian or spherical coordinates, transformed by their poses; with colours and
// normals if all scans have them. Points that the file marks as invalid are NaN. Every checksum must be
// right.
// - NPY: arrays of N x 3 numbers, or N x 4 to N x 9 floating-point numbers, are points: x y z, then normals
// and colours as in XYZ. An array of H x W x 3 is an organised cloud, and one of V x H x W x 3 is V organised
// clouds. Other arrays are depth images.
// - XYZ, PTS, text: the separator (blank, tab, comma, semicolon) and the columns are detected. x y z come
//   first. Three columns that are unit vectors in nine of ten rows are normals. Three columns of integers
//   from 0 to 255 or of fractions from 0 to 1 are colours. A line of column names, if there is one,
//   determines the columns instead. Other columns may contain anything. A first line may state the number of
//   points, as in PTS. Fewer points are an error. More points may follow, or the number and the points of
//   another scan. Comments (#, //) are allowed. Numbers have a decimal point, or a decimal comma if
//   semicolons separate them; they may be in quotation marks. If two columns of integers precede three
//   columns of fractions, the integers are a scanner's rows and columns, and the fractions are x y z. A first
//   column of point numbers is skipped.
// - PTX: all scans, transformed by their matrices. Points at their scanner's origin count as not measured.
Result<RawCloud> read_ply(const Source& source);
Result<RawCloud> read_pcd(const Source& source);
Result<RawCloud> read_laz(const Source& source);
Result<RawCloud> read_las(const Source& source);
Result<RawCloud> read_e57(const Source& source);
Result<RawCloud> read_splat(const Source& source);
Result<RawCloud> read_npy_points(const Source& source);
Result<RawCloud> read_gltf(const Source& source);
Result<RawCloud> read_3mf(const Source& source);
Result<RawCloud> read_off(const Source& source);
Result<RawCloud> read_stl(const Source& source);
Result<RawCloud> read_obj(const Source& source);
Result<RawCloud> read_ptx(const Source& source);
Result<RawCloud> read_text(const Source& source);

// Return the location of the points in a file that begins with `head`. Errors: those of the format's header,
// and kind input for a file of the format that cannot be read row by row.
Result<StreamRecords> find_ply_rows(const Source& head);
Result<StreamRecords> find_pcd_rows(const Source& head);
Result<StreamRecords> find_las_rows(const Source& head);

enum class Content { points, triangles, both };

struct Format {
  std::string_view name;     // name for messages
  std::string_view endings;  // endings of file names, separated by blanks
  Content content;
  bool (*is_format)(const Source&);
  Result<RawCloud> (*read)(const Source&);
  // Finds the rows for reading block by block; null if files are always read as a whole.
  Result<StreamRecords> (*find_rows)(const Source& head) = nullptr;
};

// The first entry that recognises a file reads it. Formats with a mark in their content come first, and text
// of numbers, which may begin with anything, comes last.
inline constexpr std::array formats = {
    Format{"PLY", ".ply", Content::both, is_ply, read_ply, find_ply_rows},
    Format{"PCD", ".pcd", Content::points, is_pcd, read_pcd, find_pcd_rows},
    Format{"LAZ", ".laz", Content::points, is_laz, read_laz},
    Format{"LAS", ".las", Content::points, is_las, read_las, find_las_rows},
    Format{"E57", ".e57", Content::points, is_e57, read_e57},
    Format{"splat", ".splat", Content::points, is_splat, read_splat},
    Format{"NPY", ".npy", Content::points, is_npy_points, read_npy_points},
    Format{"glTF", ".glb .gltf", Content::both, is_gltf, read_gltf},
    Format{"3MF", ".model .3mf", Content::triangles, is_3mf, read_3mf},
    Format{"OFF", ".off", Content::triangles, is_off, read_off},
    Format{"STL", ".stl", Content::triangles, is_stl, read_stl},
    Format{"OBJ", ".obj", Content::triangles, is_obj, read_obj},
    Format{"PTX", ".ptx", Content::points, is_ptx, read_ptx},
    Format{"XYZ, PTS", ".xyz .pts .txt .csv .asc", Content::points, is_text, read_text}};

// An unsupported format that errors can name, together with advice for users.
struct ForeignFormat {
  std::string_view mark;  // text in the content, or extension of the name
  std::string_view what;  // description of the format, for messages
  std::size_t at = 0;     // position of the mark in the content
};

// Formats that are recognised by the name's extension, because the content of most is just an archive.
inline constexpr std::array foreign_names = {
    ForeignFormat{".spz", "packed Gaussian splats (SPZ); SuperSplat exports them as PLY"},
    ForeignFormat{".ksplat", "packed Gaussian splats (KSPLAT); SuperSplat exports them as PLY"},
    ForeignFormat{".sog", "packed Gaussian splats (SOG); SuperSplat exports them as PLY"},
    ForeignFormat{".npz", "a NumPy archive; np.save writes one of its arrays as NPY"},
    ForeignFormat{".usdz", "a USD file; Blender exports it as glTF or PLY"},
    ForeignFormat{".usd", "a USD file; Blender exports it as glTF or PLY"},
    ForeignFormat{".usdc", "a USD file; Blender exports it as glTF or PLY"},
    ForeignFormat{".usda", "a USD file; Blender exports it as glTF or PLY"},
    ForeignFormat{".dae", "a COLLADA file; Blender exports it as glTF or PLY"},
    ForeignFormat{".blend", "a Blender file; Blender exports it as glTF or PLY"},
    ForeignFormat{".rcp", "a ReCap project; ReCap exports it as E57 or PTS"},
    ForeignFormat{".rcs", "a ReCap scan; ReCap exports it as E57 or PTS"},
    ForeignFormat{".fls", "a FARO scan; SCENE exports it as E57 or PTX"},
    ForeignFormat{".zfs", "a Zoller+Froehlich scan; LaserControl exports it as E57 or PTX"},
    ForeignFormat{".iges", "an IGES file; FreeCAD exports it as STL"},
    ForeignFormat{".igs", "an IGES file; FreeCAD exports it as STL"}};

inline constexpr std::array foreign_contents = {
    ForeignFormat{"\x89PNG", "a PNG picture"},
    ForeignFormat{"\xFF\xD8\xFF", "a JPEG picture"},
    ForeignFormat{"II*", "a TIFF picture"},
    ForeignFormat{"MM", "a TIFF picture"},
    ForeignFormat{"\x93NUMPY", "a NumPy file"},
    ForeignFormat{"\x76\x2F\x31\x01", "an OpenEXR picture; save it as a TIFF of 32-bit fractions"},
    ForeignFormat{"#?RADIANCE", "a Radiance HDR picture; save it as a TIFF of 32-bit fractions"},
    ForeignFormat{"WEBP", "a WebP picture; save it as PNG", 8},
    ForeignFormat{"ftyp", "a HEIC or AVIF picture, or a video; save a picture as PNG", 4},
    ForeignFormat{"jP  ", "a JPEG 2000 picture; save it as PNG", 4},
    ForeignFormat{"JXL ", "a JPEG XL picture; save it as PNG", 4},
    ForeignFormat{"\xFF\x0A", "a JPEG XL picture; save it as PNG"},
    ForeignFormat{"P7\n", "a PAM picture; save it as PNG or PGM"},
    ForeignFormat{"GIF8", "a GIF picture; save it as PNG"},
    ForeignFormat{"8BPS", "a Photoshop picture; save it as a PNG or TIFF of 16 bits"},
    ForeignFormat{"SIMPLE  =", "a FITS picture; save it as a TIFF of 32-bit fractions"},
    ForeignFormat{"DSAA", "a Surfer grid; save it as a GeoTIFF or an Esri grid"},
    ForeignFormat{"DSBB", "a Surfer grid; save it as a GeoTIFF or an Esri grid"},
    ForeignFormat{"DSRB", "a Surfer grid; save it as a GeoTIFF or an Esri grid"},
    ForeignFormat{"\x89HDF", "an HDF5 file; save its array of heights as NPY"},
    ForeignFormat{"MATLAB 5", "a MATLAB file; save its matrix of heights as CSV"},
    ForeignFormat{"{", "a JSON file"},
    ForeignFormat{"<", "an XML or HTML file"},
    ForeignFormat{"#VRML", "a VRML file"},
    ForeignFormat{"Kaydara FBX", "an FBX file; Blender exports it as glTF or PLY"},
    ForeignFormat{"%PDF", "a PDF file"},
    ForeignFormat{"PK\x03\x04", "a ZIP archive"},
    ForeignFormat{"\x1F\x8B", "a gzip archive"},
    ForeignFormat{"7z\xBC\xAF", "a 7z archive"},
    ForeignFormat{"\xFF\xFE", "UTF-16 text"},
    ForeignFormat{"\xFE\xFF", "UTF-16 text"}};

inline constexpr std::array foreign_endings = {
    ForeignFormat{".3ds", "a 3DS file; Blender exports it as glTF or PLY"},
    ForeignFormat{".dxf", "a DXF file"},
    ForeignFormat{".fbx", "an FBX file; Blender exports it as glTF or PLY"},
    ForeignFormat{".mtl", "a file of OBJ materials"},
    ForeignFormat{".step", "a STEP file; FreeCAD exports it as STL"},
    ForeignFormat{".stp", "a STEP file; FreeCAD exports it as STL"},
    ForeignFormat{".tif", "a TIFF picture"},
    ForeignFormat{".tiff", "a TIFF picture"},
    ForeignFormat{".raw", "numbers or a photo without a header; save heights as NPY or TIFF, a photo as PNG"},
    ForeignFormat{".ply", "a file that does not begin with the line 'ply'"}};

// Returns a description, such as "a ZIP archive", of a file in an unsupported format or with unknown binary
// data. Returns no description for text that does not begin like an unsupported format.
std::string foreign_format(const Source& source);

// Returns the names of the formats with that content, such as "PLY, PCD, LAS".
std::string format_names(Content content);

// Returns the names of the picture formats, such as "PNG, TIFF".
std::string picture_names();

// Returns the names of the formats that can be read row by row, such as "PLY, PCD or LAS".
std::string row_format_names();

}  // namespace relievo::io
