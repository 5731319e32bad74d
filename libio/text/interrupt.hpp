#pragma once
/// Ctrl-C, and the signals by which schedulers end a job.

namespace whirl::inline io {

/// From now on the first Ctrl-C (SIGINT) asks to stop, and the second one ends the program as
/// usual; SIGTERM and SIGUSR1 ask likewise, however often they come, as a scheduler may send them
/// to every process, and again through the program that started the processes. Until
/// is_interrupted() is called for the first time nothing would stop, and each of these signals ends
/// the program as usual.
void install_interrupt_handler();
/// Whether such a signal has asked to stop; long work calls this, and stops with what it has.
bool is_interrupted();

}  // namespace whirl::inline io
