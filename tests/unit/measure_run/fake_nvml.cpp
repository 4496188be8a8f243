// Imitates libnvidia-ml with two cards, the second of which reports no energy.

namespace {
unsigned long long millijoules = 5000;
}

extern "C" {

int nvmlInit_v2() {
  return 0;
}
int nvmlDeviceGetCount_v2(unsigned* count) {
  *count = 2;
  return 0;
}
int nvmlDeviceGetHandleByIndex_v2(unsigned index, void** card) {
  static int cards[2];
  *card = &cards[index];
  return 0;
}
int nvmlDeviceGetTotalEnergyConsumption(void* card, unsigned long long* energy) {
  static void* first = nullptr;
  if (first == nullptr) nvmlDeviceGetHandleByIndex_v2(0, &first);
  if (card != first) return 3;  // the error code NVML_ERROR_NOT_SUPPORTED
  *energy = millijoules;
  return 0;
}

void fake_nvml_take(unsigned long long more) {
  millijoules += more;
}
}
