#define FORMAT RG_FORMAT_ORI
#include "reader.h"
