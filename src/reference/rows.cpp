#include "reference/rows.hpp"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <thread>
#include <vector>

namespace triptych::reference {

void for_each_row(int rows, int threads, const std::function<RowWorker()>& make_worker,
                  const OnRows& on_rows) {
  if (rows <= 0) return;
  const int wanted = threads > 0 ? threads : static_cast<int>(std::thread::hardware_concurrency());
  const int count = std::clamp(wanted, 1, rows);
  std::atomic<int> next{0};
  std::atomic<int> done{0};
  std::vector<std::exception_ptr> failures(static_cast<std::size_t>(count));
  const auto work = [&](std::exception_ptr& failure, const OnRows& report) {
    try {
      const RowWorker draw = make_worker();
      for (int row = next++; row < rows; row = next++) {
        draw(row);
        const int completed = ++done;
        if (report && completed < rows) report(static_cast<double>(completed) / rows);
      }
    } catch (...) {
      failure = std::current_exception();
      next = rows;  // stops the other threads
    }
  };
  {
    std::vector<std::jthread> pool;
    for (std::size_t i = 1; i < failures.size(); ++i) {
      pool.emplace_back([&work, &failure = failures[i]] { work(failure, {}); });
    }
    if (on_rows) on_rows(0);
    work(failures[0], on_rows);
  }
  for (const std::exception_ptr& failure : failures) {
    if (failure) std::rethrow_exception(failure);
  }
  if (on_rows) on_rows(1);
}

}  // namespace triptych::reference
