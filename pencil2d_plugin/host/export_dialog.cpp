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

const QString PathSetting = QStringLiteral("LastSavePath/ImageSequence");

template <class Widget> Widget* findWidget(QDialog* dialog, const char* name)
{
    return dialog->findChild<Widget*>(QLatin1String(name));
}

/// The dialog opens with the last path used: there is no other way to set it. The original one is restored.
class TemporaryPath
{
public:
    TemporaryPath(QSettings* settings, const QString& path)
        : mSettings(settings), mOriginal(settings->value(PathSetting))
    {
        mSettings->setValue(PathSetting, path);
    }
    ~TemporaryPath()
    {
        if (mOriginal.isValid())
            mSettings->setValue(PathSetting, mOriginal);
        else
            mSettings->remove(PathSetting);
    }
    Q_DISABLE_COPY_MOVE(TemporaryPath)

private:
    QSettings* mSettings;
    QVariant mOriginal;
};

bool readDialog(QDialog* dialog, ExportResult* exported)
{
    const auto* cameras = findWidget<QComboBox>(dialog, "cameraCombo");
    const auto* end = findWidget<QSpinBox>(dialog, "endSpinBox");
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

/// Fill in the dialog and accept it. False if it is not the known dialog or does not accept the values.
bool acceptFrames(QDialog* dialog, int first, int last, const QString& camera, const QString& path)
{
    auto* cameras = findWidget<QComboBox>(dialog, "cameraCombo");
    const auto* file = findWidget<QLineEdit>(dialog, "fileEdit");
    auto* start = findWidget<QSpinBox>(dialog, "startSpinBox");
    auto* end = findWidget<QSpinBox>(dialog, "endSpinBox");
    auto* transparency = findWidget<QCheckBox>(dialog, "cbTransparency");
    auto* keyframesOnly = findWidget<QCheckBox>(dialog, "cbExportKeyframesOnly");
    if (cameras == nullptr || file == nullptr || start == nullptr || end == nullptr ||
        transparency == nullptr)
        return false;
    if (!file->text().contains(path))
        return false;
    if (!camera.isEmpty())
        cameras->setCurrentIndex(cameras->findText(camera));
    // Each spin box limits the other: first widen the range, then narrow it.
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

ExportResult ExportDialog::openDialog(const std::function<bool(QDialog*)>& answer)
{
    ExportResult exported;
    QAction* action = mParts.action("actionExport_ImageSeq");
    if (action == nullptr)
    {
        exported.error = QStringLiteral("There is no image sequence export.");
        return exported;
    }
    bool isKnown = false;
    bool isAccepted = false;
    const UnseenDialogs dialogs(
        [&](QDialog* dialog)
        {
            isKnown = isKnown || readDialog(dialog, &exported);
            isAccepted = isAccepted || (isKnown && answer(dialog));
        });
    action->trigger();
    if (!dialogs.complaints().isEmpty())
        exported.error = dialogs.complaints().join(QLatin1Char(' '));
    else if (!isKnown)
        exported.error = QStringLiteral("The export dialog did not open, or is not the one we know.");
    else if (!isAccepted)
        exported.error = QStringLiteral("The export dialog did not take our path, range or camera.");
    return exported;
}

ExportResult ExportDialog::inspect()
{
    return openDialog([](QDialog*) { return true; });
}

ExportResult ExportDialog::exportFrames(int first, int last, const QString& camera, const QString& directory)
{
    const QString path = QDir(directory).filePath(QStringLiteral("frame.png"));
    const TemporaryPath temporaryPath(&mSettings, path);
    ExportResult exported =
        openDialog([&](QDialog* dialog) { return acceptFrames(dialog, first, last, camera, path); });
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
