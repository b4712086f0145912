// BLAS, LAPACK and METIS serve supernodal factors and LU factors alone, which most runs do without; to load them takes
// longer than a small run. In a program that has SuiteSparse inside, its calls of them come here. The first call of a
// function loads the library, which stays the one that the system has chosen (update-alternatives).
#include <dlfcn.h>

#include <stdexcept>
#include <string>

namespace {

template <class Function>
Function* function_of(const char* library, const char* name) {
  void* const handle = ::dlopen(library, RTLD_NOW | RTLD_LOCAL);
  void* const function = handle != nullptr ? ::dlsym(handle, name) : nullptr;
  if (function == nullptr)
    throw std::runtime_error("cannot load " + std::string(name) + " from " + library + ": " + ::dlerror() +
                             "; install the packages libblas3, liblapack3 and libmetis5");
  return reinterpret_cast<Function*>(function);
}

using P = void*;  // Fortran takes all by address, and METIS does so, too

}  // namespace

#define ARCWALL_LATE(library, result, name, parameters, arguments)                \
  extern "C" result name parameters {                                             \
    static auto* const function = function_of<result parameters>(library, #name); \
    return function arguments;                                                    \
  }
#define ARCWALL_LATE_BLAS(name, parameters, arguments) ARCWALL_LATE("libblas.so.3", void, name, parameters, arguments)
#define ARCWALL_LATE_LAPACK(name, parameters, arguments) \
  ARCWALL_LATE("liblapack.so.3", void, name, parameters, arguments)
#define ARCWALL_LATE_METIS(name, parameters, arguments) ARCWALL_LATE("libmetis.so.5", int, name, parameters, arguments)

#define ARCWALL_5 (P a, P b, P c, P d, P e), (a, b, c, d, e)
#define ARCWALL_7 (P a, P b, P c, P d, P e, P f, P g), (a, b, c, d, e, f, g)
#define ARCWALL_8 (P a, P b, P c, P d, P e, P f, P g, P h), (a, b, c, d, e, f, g, h)
#define ARCWALL_9 (P a, P b, P c, P d, P e, P f, P g, P h, P i), (a, b, c, d, e, f, g, h, i)
#define ARCWALL_10 (P a, P b, P c, P d, P e, P f, P g, P h, P i, P j), (a, b, c, d, e, f, g, h, i, j)
#define ARCWALL_11 (P a, P b, P c, P d, P e, P f, P g, P h, P i, P j, P k), (a, b, c, d, e, f, g, h, i, j, k)
#define ARCWALL_13 \
  (P a, P b, P c, P d, P e, P f, P g, P h, P i, P j, P k, P l, P m), (a, b, c, d, e, f, g, h, i, j, k, l, m)
#define ARCWALL_WITH(kind, name, list) ARCWALL_WITH_LIST(kind, name, list)
#define ARCWALL_WITH_LIST(kind, name, ...) kind(name, __VA_ARGS__)

ARCWALL_WITH(ARCWALL_LATE_BLAS, dgemm_, ARCWALL_13)
ARCWALL_WITH(ARCWALL_LATE_BLAS, dgemv_, ARCWALL_11)
ARCWALL_WITH(ARCWALL_LATE_BLAS, dger_, ARCWALL_9)
ARCWALL_WITH(ARCWALL_LATE_BLAS, dsyrk_, ARCWALL_10)
ARCWALL_WITH(ARCWALL_LATE_BLAS, dtrsm_, ARCWALL_11)
ARCWALL_WITH(ARCWALL_LATE_BLAS, dtrsv_, ARCWALL_8)
ARCWALL_WITH(ARCWALL_LATE_LAPACK, dpotrf_, ARCWALL_5)
// SuiteSparse names the complex ones as well.
ARCWALL_WITH(ARCWALL_LATE_BLAS, zgemm_, ARCWALL_13)
ARCWALL_WITH(ARCWALL_LATE_BLAS, zgemv_, ARCWALL_11)
ARCWALL_WITH(ARCWALL_LATE_BLAS, zgeru_, ARCWALL_9)
ARCWALL_WITH(ARCWALL_LATE_BLAS, zherk_, ARCWALL_10)
ARCWALL_WITH(ARCWALL_LATE_BLAS, ztrsm_, ARCWALL_11)
ARCWALL_WITH(ARCWALL_LATE_BLAS, ztrsv_, ARCWALL_8)
ARCWALL_WITH(ARCWALL_LATE_LAPACK, zpotrf_, ARCWALL_5)
ARCWALL_WITH(ARCWALL_LATE_METIS, METIS_NodeND, ARCWALL_7)
ARCWALL_WITH(ARCWALL_LATE_METIS, METIS_ComputeVertexSeparator, ARCWALL_7)
