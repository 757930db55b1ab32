#include "host/layer_import.h"

#include "host/export_dialog.h"
#include "host/unseen_dialogs.h"

#include <QEventLoop>
#include <QFileDialog>
#include <QLineEdit>
#include <QListWidget>
#include <QTimer>

namespace lampblack
{

namespace
{

constexpr int OpenTimeoutMs = 10000; ///< for the dialog to open, not for the import

/// Restores the folders that Pencil2D's file dialogs open in.
class TemporaryFolders
{
public:
    TemporaryFolders()
    {
        const QStringList keys = mSettings.allKeys();
        for (const QString& key : keys)
        {
            if (isFolder(key))
                mOriginals.insert(key, mSettings.value(key));
        }
    }
    ~TemporaryFolders()
    {
        const QStringList keys = mSettings.allKeys();
        for (const QString& key : keys)
        {
            if (isFolder(key) && !mOriginals.contains(key))
                mSettings.remove(key);
        }
        for (auto folder = mOriginals.cbegin(); folder != mOriginals.cend(); ++folder)
            mSettings.setValue(folder.key(), folder.value());
    }
    Q_DISABLE_COPY_MOVE(TemporaryFolders)

private:
    static bool isFolder(const QString& key) { return key.startsWith(QLatin1String("LastOpenPath/")); }

    QuietSettings mSettings;
    QMap<QString, QVariant> mOriginals;
};

void chooseFile(QFileDialog* dialog, const QString& path)
{
    dialog->selectFile(path);
    if (auto* name = dialog->findChild<QLineEdit*>(QStringLiteral("fileNameEdit")))
        name->setText(path);
    QMetaObject::invokeMethod(dialog, "accept", Qt::DirectConnection);
}

bool clickButton(QDialog* dialog, const char* name)
{
    auto* button = dialog->findChild<QAbstractButton*>(QLatin1String(name));
    if (button == nullptr || !button->isEnabled())
        return false;
    button->click();
    return true;
}

/// Operate the import dialog. False if it is not the known dialog or does not accept our file.
bool acceptLayer(QDialog* dialog, const QString& layer)
{
    auto* list = dialog->findChild<QListWidget*>(QStringLiteral("lwLayers"));
    if (list == nullptr || !clickButton(dialog, "btnSelectFile"))
        return false;
    const auto found = list->findItems(layer, Qt::MatchExactly);
    if (found.size() != 1)
        return false;
    list->clearSelection();
    found.first()->setSelected(true);
    return clickButton(dialog, "btnImportLayers") && clickButton(dialog, "btnClose");
}

} // namespace

QString importLayer(const Parts& parts, const QString& project, const QString& layer)
{
    QAction* action = parts.action("actionImportLayers_from_pclx");
    if (action == nullptr)
        return QStringLiteral("There is no import of layers.");
    const TemporaryFolders temporaryFolders;
    bool isOpened = false;
    bool isAccepted = false;
    QEventLoop wait;
    const UnseenDialogs dialogs(
        [&](QDialog* dialog)
        {
            if (auto* files = qobject_cast<QFileDialog*>(dialog))
            {
                chooseFile(files, project);
                return;
            }
            if (isOpened)
                return;
            isOpened = true;
            isAccepted = acceptLayer(dialog, layer);
            wait.quit();
        });
    action->trigger();
    if (!isOpened)
    {
        QTimer::singleShot(OpenTimeoutMs, &wait, &QEventLoop::quit);
        wait.exec(QEventLoop::ExcludeUserInputEvents);
    }
    if (!dialogs.complaints().isEmpty())
        return dialogs.complaints().join(QLatin1Char(' '));
    if (!isOpened)
        return QStringLiteral("The import dialog did not open.");
    return isAccepted ? QString() : QStringLiteral("The import dialog did not take our file or layer.");
}

} // namespace lampblack
