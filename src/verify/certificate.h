/* certificate.h -- is a written motion one that paper can make? All that is found, and how it is said.
 * Uses  read/read.h record.h pieces.h isometry.h through.h pile.h given.h        Used by  rigami.h's callers */
#ifndef RG_CERTIFICATE_H
#define RG_CERTIFICATE_H

#include "verify/faults.h"
#include "verify/isometry.h"
#include "verify/pile.h"
#include "verify/through.h"

struct rg_certificate {
    rg_memory mem;
    rg_certificate_info info;
    rg_isometry isometry;
    rg_through through;
    rg_pile pile;
    double *percent; /* [info.frames] */
    rg_faults faults;
};

#endif
