#define TOML_IMPLEMENTATION
#include "scene/toml.h"
