// Mirrors technique::RaycastParameters (raycast_parameters.hpp), which explains each field.
typedef struct {
  real4 eye;
  real4 ray_centre;
  real4 ray_right;
  real4 ray_up;
  real4 inverse_spacing;
  real4 value_map;
  real4 shading;
  real4 background;
  int4 volume_size;
  int4 brick_grid;
  int4 viewport;
#if TRI_PARTS
  int4 part;  // technique::PartParameters
  int4 pass;
#endif
} Parameters;
