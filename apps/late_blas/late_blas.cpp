// What the archives of CHOLMOD and UMFPACK, and dense_ldlt.cpp, call of BLAS, LAPACK and METIS: each function looks for
// its namesake in the library when it is called for the first time. Most runs call none, and to load OpenBLAS with all
// that belongs to it takes longer than to trace a small structure.
//
// All arguments are addresses, but for the lengths of texts that Fortran adds and nobody reads; C callers leave them
// out.

#include <dlfcn.h>

#include <boost/preprocessor/repetition/enum_params.hpp>
#include <cstdio>
#include <cstdlib>

namespace {

// Ends the program where there is none: callers in C have no way to say so.
template <class Function>
Function function_of(const char* library, const char* name) {
  void* const opened = dlopen(library, RTLD_NOW | RTLD_LOCAL);
  void* const found = opened == nullptr ? nullptr : dlsym(opened, name);
  if (found == nullptr) {
    std::fprintf(stderr, "error: %s, which large structures need, cannot be used: %s\n", library, dlerror());
    std::_Exit(EXIT_FAILURE);
  }
  return reinterpret_cast<Function>(found);
}

}  // namespace

#define ARCWALL_LATE(library, result, name, count)                             \
  extern "C" result name(BOOST_PP_ENUM_PARAMS(count, void* a));                \
  extern "C" result name(BOOST_PP_ENUM_PARAMS(count, void* a)) {               \
    static const auto function = function_of<decltype(&name)>(library, #name); \
    return function(BOOST_PP_ENUM_PARAMS(count, a));                           \
  }
#define ARCWALL_BLAS(name, count) ARCWALL_LATE("libblas.so.3", void, name, count)
#define ARCWALL_LAPACK(name, count) ARCWALL_LATE("liblapack.so.3", void, name, count)
#define ARCWALL_METIS(name, count) ARCWALL_LATE("libmetis.so.5", int, name, count)

ARCWALL_BLAS(dgemm_, 13)
ARCWALL_BLAS(dgemv_, 11)
ARCWALL_BLAS(dger_, 9)
ARCWALL_BLAS(dsyrk_, 10)
ARCWALL_BLAS(dtrsm_, 11)
ARCWALL_BLAS(dtrsv_, 8)
ARCWALL_BLAS(zgemm_, 13)
ARCWALL_BLAS(zgemv_, 11)
ARCWALL_BLAS(zgeru_, 9)
ARCWALL_BLAS(zherk_, 10)
ARCWALL_BLAS(ztrsm_, 11)
ARCWALL_BLAS(ztrsv_, 8)
ARCWALL_LAPACK(dpotrf_, 5)
ARCWALL_LAPACK(dsytrf_, 8)
ARCWALL_LAPACK(dsytrs_, 9)
ARCWALL_LAPACK(zpotrf_, 5)
ARCWALL_METIS(METIS_ComputeVertexSeparator, 7)
ARCWALL_METIS(METIS_NodeND, 7)

// What they call of GCC's OpenMP: the loops of CHOLMOD's supernodal factorization over single blocks, which take four
// threads longer than one (sprung_cholesky.cpp).
extern "C" {
void GOMP_parallel(void (*loop)(void*), void* data, unsigned threads, unsigned flags);
int omp_get_num_threads();
int omp_get_thread_num();

void GOMP_parallel(void (*loop)(void*), void* data, unsigned /*threads*/, unsigned /*flags*/) { loop(data); }
int omp_get_num_threads() { return 1; }
int omp_get_thread_num() { return 0; }
}
