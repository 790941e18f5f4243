/* The host loads the library itself: it copies the segments and relocates relative addresses. There is no dynamic linker,
   and the process provides no symbols. ELF, 64 bits, x86-64 and arm64. */
#define _GNU_SOURCE
#include "load.h"

#include <elf.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>

struct library {
    char *base;
    size_t size;
    const Elf64_Sym *symbols;
    const char *names;
    const uint32_t *hash;
};

/* R_X86_64_RELATIVE, _GLOB_DAT, _JUMP_SLOT and _64, and the same for arm64 */
enum { X86_64_RELATIVE = 8, X86_64_GLOB_DAT = 6, X86_64_JUMP_SLOT = 7, X86_64_64 = 1 };
enum { AARCH64_RELATIVE = 1027, AARCH64_GLOB_DAT = 1025, AARCH64_JUMP_SLOT = 1026, AARCH64_ABS64 = 257 };

static void *fail(char *message, size_t size, const char *why) {
    snprintf(message, size, "%s", why);
    return NULL;
}

static char *read_file(const char *path) {
    FILE *file = fopen(path, "rb");
    if (file == NULL || fseek(file, 0, SEEK_END) != 0) {
        return NULL;
    }
    size_t length = (size_t)ftell(file);
    rewind(file);
    char *bytes = malloc(length);
    bytes = bytes != NULL && fread(bytes, 1, length, file) == length ? bytes : NULL;
    fclose(file);
    return bytes;
}

/* The name of an external symbol that the library needs; null if all relocations are done. */
static const char *relocate(struct library *library, const Elf64_Rela *first, size_t size) {
    for (const Elf64_Rela *entry = first; (const char *)entry < (const char *)first + size; entry++) {
        uint64_t value = (uint64_t)entry->r_addend;
        switch (ELF64_R_TYPE(entry->r_info)) {
        case X86_64_RELATIVE:
        case AARCH64_RELATIVE:
            value += (uint64_t)library->base;
            break;
        case X86_64_GLOB_DAT:
        case X86_64_JUMP_SLOT:
        case X86_64_64:
        case AARCH64_GLOB_DAT:
        case AARCH64_JUMP_SLOT:
        case AARCH64_ABS64: {
            const Elf64_Sym *symbol = &library->symbols[ELF64_R_SYM(entry->r_info)];
            if (symbol->st_shndx == SHN_UNDEF) {
                return library->names + symbol->st_name;
            }
            value += (uint64_t)library->base + symbol->st_value;
            break;
        }
        default:
            return "a relocation of another kind";
        }
        memcpy(library->base + entry->r_offset, &value, sizeof value);
    }
    return NULL;
}

static void *link_library(struct library *library, const Elf64_Dyn *dynamic, char *message, size_t size) {
    const Elf64_Rela *rela = NULL, *plt = NULL;
    size_t rela_size = 0, plt_size = 0;
    for (; dynamic->d_tag != DT_NULL; dynamic++) {
        void *at = library->base + dynamic->d_un.d_ptr;
        switch (dynamic->d_tag) {
        case DT_NEEDED: return fail(message, size, "it needs another library");
        case DT_INIT: case DT_INIT_ARRAY: return fail(message, size, "it has initializers");
        case DT_SYMTAB: library->symbols = at; break;
        case DT_STRTAB: library->names = at; break;
        case DT_GNU_HASH: library->hash = at; break;
        case DT_RELA: rela = at; break;
        case DT_RELASZ: rela_size = dynamic->d_un.d_val; break;
        case DT_JMPREL: plt = at; break;
        case DT_PLTRELSZ: plt_size = dynamic->d_un.d_val; break;
        case DT_RELR: case DT_REL: return fail(message, size, "relocations of another form");
        }
    }
    if (library->symbols == NULL || library->names == NULL || library->hash == NULL) {
        return fail(message, size, "it has no table of symbols");
    }
    const char *wanted = relocate(library, rela, rela_size);
    wanted = wanted != NULL ? wanted : relocate(library, plt, plt_size);
    if (wanted != NULL) {
        snprintf(message, size, "undefined symbol: %s", wanted);
        return NULL;
    }
    return library;
}

void *load_library(const char *path, char *message, size_t size) {
    char *file = read_file(path);
    if (file == NULL || memcmp(file, ELFMAG, SELFMAG) != 0) {
        return fail(message, size, "no ELF file can be read");
    }
    const Elf64_Ehdr *header = (const Elf64_Ehdr *)file;
    const Elf64_Phdr *segments = (const Elf64_Phdr *)(file + header->e_phoff);
    struct library *library = calloc(1, sizeof *library);
    for (int i = 0; i < header->e_phnum; i++) {
        size_t end = segments[i].p_vaddr + segments[i].p_memsz;
        library->size = segments[i].p_type == PT_LOAD && end > library->size ? end : library->size;
    }
    library->base = mmap(NULL, library->size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (library->base == MAP_FAILED) {
        return fail(message, size, "no memory");
    }
    const Elf64_Dyn *dynamic = NULL;
    for (int i = 0; i < header->e_phnum; i++) {
        if (segments[i].p_type == PT_LOAD) {
            memcpy(library->base + segments[i].p_vaddr, file + segments[i].p_offset, segments[i].p_filesz);
        } else if (segments[i].p_type == PT_DYNAMIC) {
            dynamic = (const Elf64_Dyn *)(library->base + segments[i].p_vaddr);
        }
    }
    free(file);
    if (dynamic == NULL || link_library(library, dynamic, message, size) == NULL) {
        return NULL;
    }
    __builtin___clear_cache(library->base, library->base + library->size);
    return mprotect(library->base, library->size, PROT_READ | PROT_WRITE | PROT_EXEC) == 0
        ? library : fail(message, size, "the memory can't be made executable");
}

/* The GNU hash table: a chain for each bucket, in the order of the symbols; the last hash of a chain is odd. */
bool load_function(void *handle, const char *name, void *function) {
    const struct library *library = handle;
    const uint32_t buckets = library->hash[0], first = library->hash[1], bloom = library->hash[2];
    const uint32_t *bucket = library->hash + 4 + 2 * bloom, *chain = bucket + buckets;
    uint32_t hash = 5381;
    for (const char *at = name; *at != 0; at++) {
        hash = hash * 33 + (unsigned char)*at;
    }
    for (uint32_t i = bucket[hash % buckets]; i >= first; i++) {
        if ((chain[i - first] | 1) == (hash | 1) && strcmp(library->names + library->symbols[i].st_name, name) == 0) {
            char *symbol = library->base + library->symbols[i].st_value;
            memcpy(function, &symbol, sizeof symbol);
            return true;
        }
        if (chain[i - first] & 1) {
            break;
        }
    }
    return false;
}

void unload_library(void *handle) {
    struct library *library = handle;
    munmap(library->base, library->size);
    free(library);
}

const char *host_name(void) { return "no dynamic linker"; }
