// Frames out of the program, by its own image sequence export, unseen.
#pragma once

#include "host/parts.h"

#include <QMap>
#include <QSize>
#include <QStringList>

#include <functional>

namespace lampblack
{

/// What the export dialog says and what came of it.
struct Exported
{
    QStringList cameras;      ///< first is the one Pencil2D offers
    QVector<QSize> sizes;     ///< of the cameras' pictures, pixels
    int frameCount = 0;       ///< length of the animation
    QMap<int, QString> files; ///< PNG by frame; straight alpha
    QString fault;            ///< what the program complained about; empty if all went well
};

class ExportDialog
{
public:
    explicit ExportDialog(const Parts& parts);

    /// Open the dialog, read it, and cancel: 2 ms.
    Exported look();

    /// Frames first..last through `camera` (empty: the one offered) into files under `directory`, one each.
    Exported run(int first, int last, const QString& camera, const QString& directory);

private:
    Exported open(const std::function<bool(QDialog*)>& answer);

    Parts mParts;
};

} // namespace lampblack
