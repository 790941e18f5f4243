/* ProcessPrng of Windows 10, implemented with a function of older Windows: Wine before 9 has no bcryptprimitives.dll, from
   which Rust's standard library takes its random numbers. Beside a program it replaces the missing one. */
#include <windows.h>

BOOLEAN NTAPI SystemFunction036(PVOID buffer, ULONG length);

__declspec(dllexport) BOOL WINAPI ProcessPrng(PBYTE buffer, SIZE_T length) {
    return SystemFunction036(buffer, (ULONG)length);
}
