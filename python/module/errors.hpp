#pragma once
/// Errors of the libraries as Python's.

namespace whirl::inline python {

/// From now on ModelError, NumericalError and FileError arrive as whirl.ModelError (with
/// `problems`), whirl.NumericalError and whirl.FileError.
void translate_errors();

}  // namespace whirl::inline python
