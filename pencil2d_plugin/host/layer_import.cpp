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

constexpr int PatienceMs = 10000; ///< for the dialog to open, not for the import

/// The folders that Pencil2D's file dialogs open in: ours is not to be the next.
class BorrowedFolders
{
public:
    BorrowedFolders()
    {
        const QStringList keys = mSettings.allKeys();
        for (const QString& key : keys)
        {
            if (isFolder(key))
                mBefore.insert(key, mSettings.value(key));
        }
    }
    ~BorrowedFolders()
    {
        const QStringList keys = mSettings.allKeys();
        for (const QString& key : keys)
        {
            if (isFolder(key) && !mBefore.contains(key))
                mSettings.remove(key);
        }
        for (auto folder = mBefore.cbegin(); folder != mBefore.cend(); ++folder)
            mSettings.setValue(folder.key(), folder.value());
    }
    Q_DISABLE_COPY_MOVE(BorrowedFolders)

private:
    static bool isFolder(const QString& key) { return key.startsWith(QLatin1String("LastOpenPath/")); }

    QuietSettings mSettings;
    QMap<QString, QVariant> mBefore;
};

void choose(QFileDialog* dialog, const QString& path)
{
    dialog->selectFile(path);
    if (auto* name = dialog->findChild<QLineEdit*>(QStringLiteral("fileNameEdit")))
        name->setText(path);
    QMetaObject::invokeMethod(dialog, "accept", Qt::DirectConnection);
}

bool click(QDialog* dialog, const char* name)
{
    auto* button = dialog->findChild<QAbstractButton*>(QLatin1String(name));
    if (button == nullptr || !button->isEnabled())
        return false;
    button->click();
    return true;
}

/// Go through the dialog of imports; false if it is not the one we know or does not take our file.
bool orderLayer(QDialog* dialog, const QString& layer)
{
    auto* list = dialog->findChild<QListWidget*>(QStringLiteral("lwLayers"));
    if (list == nullptr || !click(dialog, "btnSelectFile"))
        return false;
    const auto found = list->findItems(layer, Qt::MatchExactly);
    if (found.size() != 1)
        return false;
    list->clearSelection();
    found.first()->setSelected(true);
    return click(dialog, "btnImportLayers") && click(dialog, "btnClose");
}

} // namespace

QString importLayer(const Parts& parts, const QString& project, const QString& layer)
{
    QAction* action = parts.action("actionImportLayers_from_pclx");
    if (action == nullptr)
        return QStringLiteral("There is no import of layers.");
    const BorrowedFolders borrowed;
    bool opened = false;
    bool ordered = false;
    QEventLoop wait;
    const UnseenDialogs unseen(
        [&](QDialog* dialog)
        {
            if (auto* files = qobject_cast<QFileDialog*>(dialog))
            {
                choose(files, project);
                return;
            }
            if (opened)
                return;
            opened = true;
            ordered = orderLayer(dialog, layer);
            wait.quit();
        });
    action->trigger();
    if (!opened)
    {
        QTimer::singleShot(PatienceMs, &wait, &QEventLoop::quit);
        wait.exec(QEventLoop::ExcludeUserInputEvents);
    }
    if (!unseen.complaints().isEmpty())
        return unseen.complaints().join(QLatin1Char(' '));
    if (!opened)
        return QStringLiteral("The import dialog did not open.");
    return ordered ? QString() : QStringLiteral("The import dialog did not take our file or layer.");
}

} // namespace lampblack
