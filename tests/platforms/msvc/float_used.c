/* The mark of floating point, which Microsoft's C library has and that of mingw doesn't. */
int _fltused = 1;
