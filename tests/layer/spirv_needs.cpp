#include "tests/layer/spirv_needs.hpp"

#include <map>

namespace triptych::layer {
namespace {

// Opcodes from the SPIR-V specification.
enum Op : std::uint32_t {
  op_entry_point = 15,
  op_execution_mode = 16,
  op_capability = 17,
  op_type_int = 21,
  op_type_float = 22,
  op_type_vector = 23,
  op_type_array = 28,
  op_type_struct = 30,
  op_type_pointer = 32,
  op_constant = 43,
  op_variable = 59,
  op_store = 62,
  op_access_chain = 65,
  op_atomic_first = 228,  // OpAtomicStore
  op_atomic_last = 242,   // OpAtomicXor
};
constexpr std::uint32_t local_size = 17;
constexpr std::uint32_t workgroup = 4;
constexpr std::uint32_t uniform = 2;  // the storage class in which SPIR-V 1.0 has storage buffers
constexpr std::uint32_t storage_buffer = 12;
constexpr std::size_t header_words = 5;

class Reader {
 public:
  void read(std::uint32_t op, std::span<const std::uint32_t> words);
  ShaderNeeds needs;

 private:
  void read_type(std::uint32_t op, std::span<const std::uint32_t> words);
  void read_use(std::uint32_t op, std::span<const std::uint32_t> words);

  std::map<std::uint32_t, std::uint64_t> bytes_;  // sizes of types
  std::map<std::uint32_t, std::uint32_t> constants_;
  std::map<std::uint32_t, std::uint32_t> storage_;   // storage classes of pointer types
  std::map<std::uint32_t, std::uint32_t> pointees_;  // the types to which pointer types point
  std::set<std::uint32_t> into_buffers_;             // pointers into buffers
};

void Reader::read_type(std::uint32_t op, std::span<const std::uint32_t> words) {
  if (op == op_type_int || op == op_type_float) bytes_[words[1]] = words[2] / 8;
  if (op == op_type_vector) bytes_[words[1]] = bytes_[words[2]] * words[3];
  if (op == op_type_array) bytes_[words[1]] = bytes_[words[2]] * constants_[words[3]];
  if (op == op_type_struct) {
    for (const std::uint32_t member : words.subspan(2)) bytes_[words[1]] += bytes_[member];
  }
  if (op == op_type_pointer) {
    storage_[words[1]] = words[2];
    pointees_[words[1]] = words[3];
  }
  if (op == op_constant) constants_[words[2]] = words[3];
}

void Reader::read_use(std::uint32_t op, std::span<const std::uint32_t> words) {
  if (op == op_variable && words[3] == workgroup) {
    needs.shared_bytes += bytes_[pointees_[words[1]]];
  }
  if (op == op_access_chain &&
      (storage_[words[1]] == storage_buffer || storage_[words[1]] == uniform)) {
    into_buffers_.insert(words[2]);
  }
  if (op == op_store && into_buffers_.contains(words[1])) needs.writes_buffers = true;
  if (op >= op_atomic_first && op <= op_atomic_last) {
    const std::uint32_t pointer = op == op_atomic_first ? words[1] : words[3];
    if (into_buffers_.contains(pointer)) needs.writes_buffers = true;
  }
}

void Reader::read(std::uint32_t op, std::span<const std::uint32_t> words) {
  if (op == op_capability) needs.capabilities.insert(words[1]);
  if (op == op_entry_point) needs.model = words[1];
  if (op == op_execution_mode && words[2] == local_size) {
    needs.group = {words[3], words[4], words[5]};
  }
  read_type(op, words);
  read_use(op, words);
}

}  // namespace

ShaderNeeds shader_needs(std::span<const std::uint32_t> code) {
  Reader reader;
  for (std::size_t at = header_words; at < code.size();) {
    const std::size_t count = code[at] >> 16U;
    if (count == 0 || at + count > code.size()) break;
    reader.read(code[at] & 0xFFFFU, code.subspan(at, count));
    at += count;
  }
  return reader.needs;
}

}  // namespace triptych::layer
