/* Loaded before all others (LD_PRELOAD): makes a machine that lacks what HIDE names: gl, x264, font. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <stdlib.h>
#include <string.h>

static int hidden(const char* what) {
  const char* hide = getenv("HIDE");
  return hide != NULL && strstr(hide, what) != NULL;
}

void* dlopen(const char* name, int mode) {
  void* (*next)(const char*, int) = (void* (*)(const char*, int))dlsym(RTLD_NEXT, "dlopen");
  const int is_gl = name != NULL && (strstr(name, "OSMesa") != NULL || strstr(name, "EGL") != NULL);
  return next(is_gl && hidden("gl") ? "hidden.so" : name, mode);
}

const void* avcodec_find_encoder_by_name(const char* name) {
  const void* (*next)(const char*) = (const void* (*)(const char*))dlsym(RTLD_NEXT, "avcodec_find_encoder_by_name");
  return hidden("x264") ? NULL : next(name);
}

int FT_New_Face(void* library, const char* file, long index, void** face) {
  int (*next)(void*, const char*, long, void**) = (int (*)(void*, const char*, long, void**))dlsym(RTLD_NEXT, "FT_New_Face");
  return hidden("font") ? 1 : next(library, file, index, face); /* cannot open resource */
}
