#define FORMAT RG_FORMAT_OPX
#include "reader.h"
