#include "io/vtpWriter.hpp"

#include <vtkObjectFactory.h>

#include <ostream>
#include <string>

#include "io/xml.hpp"

namespace corpuscle::io {
namespace {

class VtpWriter : public vtkXMLPolyDataWriter {
  public:
    static VtpWriter* New();
    vtkTypeMacro(VtpWriter, vtkXMLPolyDataWriter);

  protected:
    VtpWriter() {
        SetDataModeToAppended();
        EncodeAppendedDataOff();
        SetCompressorTypeToLZ4();
        SetHeaderTypeToUInt64();
    }
    int StartFile() override {
        *Stream << rawByDefault << '\n';
        return Superclass::StartFile();
    }
    // Blanks overwrite the attribute: those before the underscore mean nothing.
    int EndFile() override {
        const std::string written = "<AppendedData encoding=\"raw\">\n   _", tag = "<AppendedData>";
        const auto end = Stream->tellp();
        Stream->seekp(AppendedDataPosition - static_cast<std::streamoff>(written.size()));
        *Stream << tag << std::string(written.size() - tag.size() - 1, ' ') << '_';
        Stream->seekp(end);
        return Superclass::EndFile();
    }
};

vtkStandardNewMacro(VtpWriter);

}  // namespace

vtkSmartPointer<vtkXMLPolyDataWriter> makeVtpWriter() { return vtkSmartPointer<VtpWriter>::New(); }

}  // namespace corpuscle::io
