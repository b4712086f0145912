// CHOLMOD asks libgomp for a team of threads for each of its small loops over a dense block. To set up a team, even of
// one thread, takes longer than such a loop: with it large frames take two to three times as long. This program works
// with one thread, so that a loop runs at once. CHOLMOD's calls come here, because the functions of a program stand
// before those of shared libraries.
extern "C" void GOMP_parallel(void (*loop)(void*), void* data, unsigned /*threads*/, unsigned /*flags*/) { loop(data); }
extern "C" int omp_get_num_threads() { return 1; }
extern "C" int omp_get_thread_num() { return 0; }
