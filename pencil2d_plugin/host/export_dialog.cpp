#include "host/export_dialog.h"

#include "host/unseen_dialogs.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDir>
#include <QEvent>
#include <QLineEdit>
#include <QSpinBox>

namespace lampblack
{

namespace
{

const QString PathKey = QStringLiteral("LastSavePath/ImageSequence");

template <class Widget> Widget* child(QDialog* dialog, const char* name)
{
    return dialog->findChild<Widget*>(QLatin1String(name));
}

/// The only way to tell the dialog a path: it opens with the last one used. The artist's own comes back.
class BorrowedPath
{
public:
    BorrowedPath(QSettings* settings, const QString& path)
        : mSettings(settings), mBefore(settings->value(PathKey))
    {
        mSettings->setValue(PathKey, path);
    }
    ~BorrowedPath()
    {
        if (mBefore.isValid())
            mSettings->setValue(PathKey, mBefore);
        else
            mSettings->remove(PathKey);
    }
    Q_DISABLE_COPY_MOVE(BorrowedPath)

private:
    QSettings* mSettings;
    QVariant mBefore;
};

bool readDialog(QDialog* dialog, Exported* exported)
{
    const auto* cameras = child<QComboBox>(dialog, "cameraCombo");
    const auto* end = child<QSpinBox>(dialog, "endSpinBox");
    if (cameras == nullptr || end == nullptr)
        return false;
    for (int i = 0; i < cameras->count(); ++i)
    {
        exported->cameras.append(cameras->itemText(i));
        exported->sizes.append(cameras->itemData(i).toSize());
    }
    exported->frameCount = end->value();
    return true;
}

/// Fill in and accept; false if the dialog is not the one we know or did not take it.
bool orderFrames(QDialog* dialog, int first, int last, const QString& camera, const QString& path)
{
    auto* cameras = child<QComboBox>(dialog, "cameraCombo");
    const auto* file = child<QLineEdit>(dialog, "fileEdit");
    auto* start = child<QSpinBox>(dialog, "startSpinBox");
    auto* end = child<QSpinBox>(dialog, "endSpinBox");
    auto* transparency = child<QCheckBox>(dialog, "cbTransparency");
    auto* keyframesOnly = child<QCheckBox>(dialog, "cbExportKeyframesOnly");
    if (cameras == nullptr || file == nullptr || start == nullptr || end == nullptr ||
        transparency == nullptr)
        return false;
    if (!file->text().contains(path))
        return false;
    if (!camera.isEmpty())
        cameras->setCurrentIndex(cameras->findText(camera));
    // The spin boxes hold each other in order: open the range, then close it.
    end->setMaximum(qMax(end->maximum(), last));
    start->setMaximum(qMax(start->maximum(), first));
    start->setValue(1);
    end->setValue(last);
    start->setValue(first);
    transparency->setChecked(true);
    if (keyframesOnly != nullptr)
        keyframesOnly->setChecked(false);
    if (start->value() != first || end->value() != last || cameras->currentIndex() < 0)
        return false;
    dialog->accept();
    return true;
}

} // namespace

bool QuietSettings::event(QEvent* event)
{
    return event->type() == QEvent::UpdateRequest || QSettings::event(event);
}

ExportDialog::ExportDialog(const Parts& parts) : mParts(parts)
{
}

Exported ExportDialog::open(const std::function<bool(QDialog*)>& answer)
{
    Exported exported;
    QAction* action = mParts.action("actionExport_ImageSeq");
    if (action == nullptr)
    {
        exported.fault = QStringLiteral("There is no image sequence export.");
        return exported;
    }
    bool known = false;
    bool taken = false;
    const UnseenDialogs unseen(
        [&](QDialog* dialog)
        {
            known = known || readDialog(dialog, &exported);
            taken = taken || (known && answer(dialog));
        });
    action->trigger();
    if (!unseen.complaints().isEmpty())
        exported.fault = unseen.complaints().join(QLatin1Char(' '));
    else if (!known)
        exported.fault = QStringLiteral("The export dialog did not open, or is not the one we know.");
    else if (!taken)
        exported.fault = QStringLiteral("The export dialog did not take our path, range or camera.");
    return exported;
}

Exported ExportDialog::look()
{
    return open([](QDialog*) { return true; });
}

Exported ExportDialog::run(int first, int last, const QString& camera, const QString& directory)
{
    const QString path = QDir(directory).filePath(QStringLiteral("frame.png"));
    const BorrowedPath borrowed(&mSettings, path);
    Exported exported = open([&](QDialog* dialog) { return orderFrames(dialog, first, last, camera, path); });
    for (int frame = first; frame <= last; ++frame)
    {
        const QString file =
            QDir(directory).filePath(QStringLiteral("frame%1.png").arg(frame, 4, 10, QLatin1Char('0')));
        if (QFile::exists(file))
            exported.files.insert(frame, file);
    }
    return exported;
}

} // namespace lampblack
