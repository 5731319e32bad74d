// Reads a model file and no more: linked with whirl::model alone.

#include <cstdio>

#include "libio/model/model_file.hpp"

int main(int count, char** words) {
  if (count != 2) return 2;
  const whirl::Model model = whirl::read_model(words[1]);
  std::printf("%zu disks, %zu contacts\n", model.structure.disks.size(), model.contacts.size());
  return model.structure.disks.empty() ? 1 : 0;
}
