// Exports frames through Pencil2D's own image sequence export, without showing its dialog.
#pragma once

#include "host/parts.h"

#include <QMap>
#include <QSettings>
#include <QSize>
#include <QStringList>

#include <functional>

namespace lampblack
{

/// What the export dialog contains, and the result of the export.
struct ExportResult
{
    QStringList cameras;      ///< names; the first is Pencil2D's default
    QVector<QSize> sizes;     ///< picture size of each camera, pixels
    int frameCount = 0;       ///< length of the animation
    QMap<int, QString> files; ///< PNG by frame; straight alpha
    QString error;            ///< error message; empty on success
};

/// Pencil2D's settings, shared with it in memory. Changes are not written to disk at once: that would block,
/// and we restore what we change.
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

    /// Open the dialog, read it, and cancel. Takes about 2 ms.
    ExportResult inspect();

    /// Export frames first..last of `camera` (empty: the default) to one file each in `directory`.
    ExportResult exportFrames(int first, int last, const QString& camera, const QString& directory);

private:
    ExportResult openDialog(const std::function<bool(QDialog*)>& answer);

    Parts mParts;
    QuietSettings mSettings;
};

} // namespace lampblack
