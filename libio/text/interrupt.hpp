#pragma once
/// Ctrl-C.

namespace whirl::inline io {

/// From now on the first Ctrl-C asks to stop, and the second one ends the program as usual.
void install_interrupt_handler();
/// Whether it did; long work looks at it and stops with what it has.
bool is_interrupted();

}  // namespace whirl::inline io
