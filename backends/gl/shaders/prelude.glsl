// GL's dialect for the shared bodies: one number names a uniform block, a texture unit and a storage
// block alike, since GL keeps the three apart.
#define TRI_BINDING(n) layout(binding = n)
