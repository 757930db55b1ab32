// Frames out of the program, by its own image sequence export, unseen.
#pragma once

#include "host/parts.h"

#include <QMap>
#include <QSettings>
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

/// Pencil2D's settings, shared with it in memory but not written by us at every change: that waits for
/// the disk, and what we change we put back.
class QuietSettings : public QSettings
{
    Q_OBJECT

public:
    QuietSettings() : QSettings(QStringLiteral("Pencil"), QStringLiteral("Pencil")) {}

protected:
    bool event(QEvent* event) override;
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
    QuietSettings mSettings;
};

} // namespace lampblack
