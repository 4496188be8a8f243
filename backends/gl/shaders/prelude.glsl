// GL's dialect for the shared shader bodies. A uniform block, a texture unit and a storage block
// may all have the same number, because GL numbers the three kinds separately.
#define TRI_BINDING(n) layout(binding = n)
