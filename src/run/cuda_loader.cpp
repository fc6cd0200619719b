// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/run/cuda_loader.h"

#include "hooke/backends/gpu/cuda_module.h"
#include "hooke/run/module_loader.h"

namespace hooke::run {
namespace {

Expected<Module> cuda_module() {
#if !HOOKE_WITH_CUDA
  return fail(Error::Kind::bad_input, "cuda", "GPUs need CUDA, which is not in this build (HOOKE_CUDA)");
#endif
  return Module::load("hooke-cuda.so", "hooke_cuda_version", "cuda", "GPUs need it");
}

// Calls a function of the module, which fills in what it is given last.
template <class Result, class Function, class... Arguments>
Expected<Result> call(const char* name, const Arguments&... arguments) {
  const auto module = cuda_module();
  if (!module) return fail(module.error());
  const auto function = module->function<Function>(name);
  if (function == nullptr) return fail(Error::Kind::bad_input, "hooke-cuda.so", "is of another version of hooke");
  Expected<Result> result;
  function(arguments..., result);
  return result;
}

}  // namespace

Expected<int> count_cuda_devices() { return call<int, decltype(hooke_count_cuda_devices)>("hooke_count_cuda_devices"); }

Expected<CudaDeviceInfo> find_cuda_device(int index) {
  return call<CudaDeviceInfo, decltype(hooke_find_cuda_device)>("hooke_find_cuda_device", index);
}

Expected<std::unique_ptr<Backend>> load_cuda_backend(const CudaOptions& options) {
  return call<std::unique_ptr<Backend>, decltype(hooke_make_cuda_backend)>("hooke_make_cuda_backend", options);
}

}  // namespace hooke::run
