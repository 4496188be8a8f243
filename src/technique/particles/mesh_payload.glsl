// The payload of a task group: 32 cells, each with the index after its last mesh group.
#define TRI_MESH_SPRITES 32u  // sprites in a mesh group, with four vertices and two triangles each
struct CellList {
  uint begin[32];
  uint count[32];
  uint end[32];
  uint groups;
};
