// GL's dialect for the shared shader bodies. One number can name a uniform block, a texture unit and a storage
// block at the same time, because GL numbers the three separately.
#define TRI_BINDING(n) layout(binding = n)
