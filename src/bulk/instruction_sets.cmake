# One source a instruction set, compiled with that set's flags alone.
