// The payload of a task group: 32 cells, each with the number that follows its last mesh group.
#define TRI_MESH_SPRITES 32u  // of a mesh group: four vertices and two triangles each
struct CellList {
  uint begin[32];
  uint count[32];
  uint end[32];
  uint groups;
};
