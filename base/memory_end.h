#pragma once
// Whether memory ended while a package was at work that hides it.
//
// Clipper keeps to itself whatever is thrown inside of it and then returns
// nothing. But operator new first calls a handler, on the thread that asked.
// There is one in a process, so the program sets it, not this library:
//
//     std::set_new_handler(lamina::note_memory_end);

#include <functional>

namespace lamina {

// A std::new_handler: notes the end of memory on this thread and throws
// std::bad_alloc.
void note_memory_end();

// Calls `work`. Throws std::bad_alloc where memory ended within, even if `work`
// returns; where another handler is set, only if `work` throws.
void watch_memory(const std::function<void()>& work);

}  // namespace lamina
