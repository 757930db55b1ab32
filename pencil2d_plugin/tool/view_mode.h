// What the canvas shows while the lamp is in use.
#pragma once

#include <QMetaType>

namespace lampblack
{

enum class ViewMode
{
    Lit,
    Normals,
    Relief,
    Flat ///< the drawing as drawn
};

} // namespace lampblack

Q_DECLARE_METATYPE(lampblack::ViewMode)
