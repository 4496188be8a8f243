// Mirrors technique::RaycastParameters (raycast_parameters.hpp), where the meaning of each field
// stands.
typedef struct {
  float4 eye;
  float4 ray_centre;
  float4 ray_right;
  float4 ray_up;
  float4 inverse_spacing;
  float4 value_map;
  float4 shading;
  float4 background;
  int4 volume_size;
  int4 brick_grid;
  int4 viewport;
} Parameters;
