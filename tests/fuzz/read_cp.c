#define FORMAT RG_FORMAT_CP
#include "reader.h"
