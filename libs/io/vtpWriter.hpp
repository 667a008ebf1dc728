// VTK's writer of PolyData, with raw appended data that every version of VTK reads.
//
// VTK feeds the beginning of a file to the XML parser Expat in parts: up to "<AppendedData", then its attributes, then
// an end of its own making, since the raw data are no XML. Expat from 2.6 on (and 2.5 with its security updates, as in
// Debian 12) does not look at an incomplete tag again until its length has doubled. With the attribute encoding="raw"
// it therefore misses the end and goes on into the data: Debian's ParaView 5.11, which uses the Expat of the system,
// cannot read the file. Here the tag has no attribute, and a document type (`rawByDefault` of xml.hpp) gives
// the value in its place.
#pragma once
#include <vtkSmartPointer.h>
#include <vtkXMLPolyDataWriter.h>

namespace corpuscle::io {

// Set to LZ4 and 64-bit heads.
vtkSmartPointer<vtkXMLPolyDataWriter> makeVtpWriter();

}  // namespace corpuscle::io
