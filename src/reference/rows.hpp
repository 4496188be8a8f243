#pragma once
// Distributes the rows of an image among threads.

#include <functional>

namespace triptych::reference {

// Draws one row. Each thread has its own worker, so a worker may reuse its own buffers.
using RowWorker = std::function<void(int row)>;

// Receives the completed share of the rows, in [0, 1].
using OnRows = std::function<void(double share)>;

// Calls a worker once for every row 0 … rows − 1, in no particular order, on `threads` threads (0
// means one for each hardware thread). The result does not depend on the number of threads if each
// row depends only on its index. Rethrows the first exception that a worker throws. `on_rows` is
// only called on the calling thread: with 0 at the beginning, after each row that this thread has
// drawn, and with 1 after all rows have been drawn.
void for_each_row(int rows, int threads, const std::function<RowWorker()>& make_worker,
                  const OnRows& on_rows = {});

}  // namespace triptych::reference
