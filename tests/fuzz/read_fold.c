#define FORMAT RG_FORMAT_FOLD
#include "reader.h"
