#pragma once
// Rows of an image shared among threads.

#include <functional>

namespace triptych::reference {

// Draws one row; each thread has its own, so that it may own scratch memory.
using RowWorker = std::function<void(int row)>;

// Calls a worker once for every row 0 … rows − 1, in no particular order, on `threads` threads (0:
// as many as the machine has). The result is independent of the thread count as long as a row is a
// function of its number alone. The first exception thrown by a worker is thrown again here.
void for_each_row(int rows, int threads, const std::function<RowWorker()>& make_worker);

}  // namespace triptych::reference
