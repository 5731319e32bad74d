#pragma once
/// Ctrl-C, and the signals by which schedulers end a job.

namespace whirl::inline io {

/// From now on the first Ctrl-C (SIGINT) asks to stop, and the second one ends the program as
/// usual; SIGTERM and SIGUSR1 ask likewise, however often they come, as a scheduler may send them
/// to every process and again by the program that started these. As long as nobody has asked
/// is_interrupted(), there is nothing to stop with: then each of them ends the program as usual.
void install_interrupt_handler();
/// Whether one of them did; long work looks at it and stops with what it has.
bool is_interrupted();

}  // namespace whirl::inline io
