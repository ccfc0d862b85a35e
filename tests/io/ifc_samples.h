// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "tests/support/places.h"

namespace clerestory::test {

inline std::filesystem::path ifc_file(const std::string& name) { return shared_data_dir() / "ifc" / name; }

/// A file of these entities.
inline std::string ifc_text(const std::string& entities, const std::string& schema = "IFC4") {
  return "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\nFILE_NAME('a.ifc','2026-01-01T00:00:00',(''),(''),'','"
         "','');\n"
         "FILE_SCHEMA(('" +
         schema + "'));\nENDSEC;\nDATA;\n" + entities + "ENDSEC;\nEND-ISO-10303-21;\n";
}

/// Project, units of millimetres, site in Munich, the placement #10 at the origin.
inline const std::string kIfcFrame =
    "#1=IFCPROJECT('1kTvXnbbzCWw8lcMd1dR4o',$,'P',$,$,$,$,(#2),#5);\n"
    "#2=IFCGEOMETRICREPRESENTATIONCONTEXT($,'Model',3,1.E-5,#3,#9);\n"
    "#3=IFCAXIS2PLACEMENT3D(#4,$,$);\n#4=IFCCARTESIANPOINT((0.,0.,0.));\n"
    "#5=IFCUNITASSIGNMENT((#6,#7,#8));\n#6=IFCSIUNIT(*,.LENGTHUNIT.,.MILLI.,.METRE.);\n"
    "#7=IFCSIUNIT(*,.AREAUNIT.,$,.SQUARE_METRE.);\n#8=IFCSIUNIT(*,.VOLUMEUNIT.,$,.CUBIC_METRE.);\n"
    "#9=IFCDIRECTION((-0.5,0.866025403784439));\n#10=IFCLOCALPLACEMENT($,#3);\n"
    "#11=IFCSITE('1kTvXnbbzCWw8lcMd1dR4p',$,'Site',$,$,#10,$,$,.ELEMENT.,(48,8,6),(-11,-30,0),$,$,$);\n";

/// A wall of 4 x 0.3 x 3 m that an opening of 1 x 1.2 m goes through, its sill at 1 m; its ends lie a film beside the wall's faces. A
/// window without a body stands in it.
inline const std::string kIfcWall =
    "#20=IFCWALL('1kTvXnbbzCWw8lcMd1dR4q',$,'South',$,$,#10,#21,$,$);\n"
    "#21=IFCPRODUCTDEFINITIONSHAPE($,$,(#22));\n#22=IFCSHAPEREPRESENTATION(#2,'Body','SweptSolid',(#23));\n"
    "#23=IFCEXTRUDEDAREASOLID(#24,#3,#26,3000.);\n#24=IFCRECTANGLEPROFILEDEF(.AREA.,$,#25,4000.,300.);\n"
    "#25=IFCAXIS2PLACEMENT2D(#27,$);\n#26=IFCDIRECTION((0.,0.,1.));\n#27=IFCCARTESIANPOINT((0.,0.));\n"
    "#30=IFCOPENINGELEMENT('1kTvXnbbzCWw8lcMd1dR4r',$,'O',$,$,#31,#35,$,.OPENING.);\n"
    "#31=IFCLOCALPLACEMENT(#10,#33);\n#33=IFCAXIS2PLACEMENT3D(#34,$,$);\n#34=IFCCARTESIANPOINT((0.,0.,1000.));\n"
    "#35=IFCPRODUCTDEFINITIONSHAPE($,$,(#36));\n#36=IFCSHAPEREPRESENTATION(#2,'Body','SweptSolid',(#37));\n"
    "#37=IFCEXTRUDEDAREASOLID(#38,#3,#26,1200.);\n#38=IFCRECTANGLEPROFILEDEF(.AREA.,$,#25,1000.,299.999);\n"
    "#40=IFCRELVOIDSELEMENT('1kTvXnbbzCWw8lcMd1dR4s',$,$,$,#20,#30);\n"
    "#41=IFCWINDOW('1kTvXnbbzCWw8lcMd1dR4t',$,'W',$,$,#31,$,$,1200.,1000.,$,$,$);\n"
    "#42=IFCRELFILLSELEMENT('1kTvXnbbzCWw8lcMd1dR4u',$,$,$,#30,#41);\n";

/// Two light fixtures of one type, the second turned by 90° and 1 m along x, both 2.8 m up, and a tap, which is none.
inline const std::string kIfcFixtures =
    "#50=IFCLIGHTFIXTURE('1kTvXnbbzCWw8lcMd1dR4v',$,'L1',$,$,#51,$,$,$);\n"
    "#51=IFCLOCALPLACEMENT(#10,#52);\n#52=IFCAXIS2PLACEMENT3D(#53,$,$);\n#53=IFCCARTESIANPOINT((500.,0.,2800.));\n"
    "#54=IFCFLOWTERMINAL('1kTvXnbbzCWw8lcMd1dR4w',$,'L2',$,$,#55,$,$);\n"
    "#55=IFCLOCALPLACEMENT(#10,#56);\n#56=IFCAXIS2PLACEMENT3D(#57,#26,#58);\n"
    "#57=IFCCARTESIANPOINT((1500.,0.,2800.));\n#58=IFCDIRECTION((0.,1.,0.));\n"
    "#59=IFCLIGHTFIXTURETYPE('1kTvXnbbzCWw8lcMd1dR4x',$,'Panel 600',$,$,$,$,$,$,.NOTDEFINED.);\n"
    "#60=IFCRELDEFINESBYTYPE('1kTvXnbbzCWw8lcMd1dR4y',$,$,$,(#50,#54),#59);\n"
    "#61=IFCFLOWTERMINAL('1kTvXnbbzCWw8lcMd1dR4z',$,'Tap',$,$,#10,$,$);\n";

}  // namespace clerestory::test
