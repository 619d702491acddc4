module;

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <cstddef>

module candela.parallel;

namespace candela {

int available_threads() noexcept { return std::max(tbb::info::default_concurrency(), 1); }

void with_threads(int threads, FunctionRef<> work) {
    tbb::task_arena arena(threads > 0 ? threads : available_threads());
    arena.execute([&] { work(); });
}

void parallel_for(std::size_t count, std::size_t grain, FunctionRef<std::size_t, std::size_t> body) {
    if (count == 0) return;
    if (count <= grain || tbb::this_task_arena::max_concurrency() == 1) return body(0, count);
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, count, grain),
        [&](const tbb::blocked_range<std::size_t>& range) { body(range.begin(), range.end()); },
        tbb::simple_partitioner{});
}

}  // namespace candela
