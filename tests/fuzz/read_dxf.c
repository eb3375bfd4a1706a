#define FORMAT RG_FORMAT_DXF
#include "reader.h"
