// The payload of a task work group. It describes 32 cells (groups of neighbouring particles, cells.glsl). end[k] is the
// index after the last mesh work group of cell k.
#define TRI_MESH_SPRITES 32u  // sprites in a mesh group, with four vertices and two triangles each
struct CellList {
  uint begin[32];
  uint count[32];
  uint end[32];
  uint groups;
};
