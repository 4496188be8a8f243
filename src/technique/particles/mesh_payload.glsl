// The payload of a task group: 32 cells. end[k] is the index after the last mesh group of cell k.
#define TRI_MESH_SPRITES 32u  // sprites in a mesh group, with four vertices and two triangles each
struct CellList {
  uint begin[32];
  uint count[32];
  uint end[32];
  uint groups;
};
