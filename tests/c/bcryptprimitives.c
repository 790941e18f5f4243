/* ProcessPrng of Windows 10, by what Windows had before: Wine before 9 has no bcryptprimitives.dll, which Rust's standard
   library takes its random numbers from. Beside a program it stands in for the missing one. */
#include <windows.h>

BOOLEAN NTAPI SystemFunction036(PVOID buffer, ULONG length);

__declspec(dllexport) BOOL WINAPI ProcessPrng(PBYTE buffer, SIZE_T length) {
    return SystemFunction036(buffer, (ULONG)length);
}
